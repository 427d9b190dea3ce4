// Bounds over a set that no comparison decides: the largest errors, levels and corrections, against samples
// that come near them.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "checker/quadrature/contraction.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::checker;

const Metric kMetric{Ball(2.0), Ball(6.0), Ball(-4.0), Ball(20.0)};

/// Errors with |T e| = level in a random direction.
std::array<double, 3> errors_of(test::Random& random, double level) {
  std::array<double, 3> u{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
  const double scale = level / std::hypot(u[0], u[1], u[2]);
  const double frequency = scale * u[2] / 20.0;
  return {scale * u[0] / 2.0, (scale * u[1] + 4.0 * frequency) / 6.0, frequency};
}

double level_of(const std::array<double, 3>& e) {
  return std::hypot(2.0 * e[0], 6.0 * e[1] - 4.0 * e[2], 20.0 * e[2]);
}

}  // namespace

TEST_CASE("errors of level 1 reach as far as the rows of the inverse metric, and no farther") {
  test::Random random(301);
  const std::array<Ball, 3> rows = inverse_rows(kMetric);
  std::array<double, 3> reached{};
  for (int k = 0; k < 20000; ++k) {
    const std::array<double, 3> e = errors_of(random, 1.0);
    for (std::size_t i = 0; i < 3; ++i) {
      reached[i] = std::max(reached[i], std::fabs(e[i]));
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(i);
    CHECK(reached[i] <= rows[i].near() * (1.0 + 1e-12));
    CHECK(reached[i] >= rows[i].near() * 0.99);
  }
}

TEST_CASE("the largest level of a box of errors is that of its worst corner") {
  double worst = 0.0;
  for (const double phase : {-0.3, 0.3}) {
    for (const double frequency : {-0.1, 0.1}) {
      worst = std::max(worst, level_of({0.2, phase, frequency}));
    }
  }
  CHECK(largest_level(kMetric, Ball(0.2), Ball(0.3), Ball(0.1)).near() ==
        doctest::Approx(worst).epsilon(1e-12));
}

TEST_CASE("noise and slew drive the level to the ultimate one") {
  Setting set;
  set.metric = kMetric;
  set.rate = Ball(0.8);
  set.noise_gain = Ball(3.0);
  set.slew_gain = Ball(5.0);
  Design design;
  design.noise = Ball(0.25);
  design.slew = Ball(0.125);
  double squared = 0.0;
  for (int k = 0; k < 400; ++k) {
    squared = 0.64 * squared + 0.75 * 0.75 + 0.625 * 0.625;
  }
  CHECK(ultimate_level(set, design).near() == doctest::Approx(std::sqrt(squared)).epsilon(1e-9));
}

TEST_CASE("starts closer than what noise leaves are bounded by what noise leaves") {
  Setting set;
  set.metric = kMetric;
  set.radius = one;
  set.rate = Ball(0.5);
  set.noise = set.slew = one;
  set.noise_gain = Ball(0.5);
  set.slew_gain = zero;
  set.lower = {Ball(0.25), Ball(0.25), zero, Ball(0.25)};
  set.upper = {one, one, zero, one};
  Design design;
  design.noise = one;
  design.slew = zero;
  design.q1 = design.q2 = design.r = one;
  design.epsilon = zero;
  design.covariance =
      std::array<std::array<Ball, 3>, 3>{{{half, zero, zero}, {zero, half, zero}, {zero, zero, half}}};
  const Tree nothing = read_json(R"({"conditions": [], "quantities": {}})");
  for (const double start : {0.0, 0.01, 0.03}) {
    CAPTURE(start);
    design.amplitude_error = design.phase_error = zero;
    design.frequency_error = Ball(start);
    Objections objections;
    const Promises promises = check_contraction(nothing, design, {{"start-error", set, true}}, objections);
    REQUIRE(promises.bound.has_value());
    const double ultimate = 0.5 / std::sqrt(0.75);
    const double level = level_of({0.0, 0.0, start});
    CHECK(promises.bound->near() == doctest::Approx(std::max(level, ultimate) / 20.0).epsilon(1e-9));
  }
}

TEST_CASE("a set that is read knows how far its amplitudes and predicted phases reach") {
  test::Random random(302);
  Design design;
  design.q1 = design.q2 = Ball(0.0023);
  design.r = Ball(0.05);
  design.epsilon = zero;
  const Tree tree = read_json(
      R"({"purpose": "settling", "metric": [["0x1p+1","0x0p+0","0x0p+0"],["0x0p+0","0x1.8p+2","-0x1p+2"],)"
      R"(["0x0p+0","0x0p+0","0x1.4p+4"]], "covariance_lower": [["0x1p-8","0x0p+0","0x0p+0"],)"
      R"(["0x0p+0","0x1p-8","0x0p+0"],["0x0p+0","0x0p+0","0x1p-8"]], "covariance_upper": )"
      R"([["0x1p-4","0x0p+0","0x0p+0"],["0x0p+0","0x1p-4","0x0p+0"],["0x0p+0","0x0p+0","0x1p-4"]], )"
      R"("radius": "0x1p-1", "noise": "0x0p+0", "slew": "0x0p+0", "rate": "0x1p-1", )"
      R"("noise_gain": "0x0p+0", "slew_gain": "0x0p+0"})");
  std::int64_t cells = 0;
  Objections objections;
  const Setting set = check_set(tree, design, cells, objections).setting;
  double amplitude = 0.0;
  double chi = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const std::array<double, 3> e = errors_of(random, 0.5);
    amplitude = std::max(amplitude, std::fabs(e[0]));
    chi = std::max(chi, std::fabs(e[1] + e[2]));
  }
  CHECK(amplitude <= set.largest_amplitude.near());
  CHECK(amplitude >= 0.99 * set.largest_amplitude.near());
  CHECK(chi <= set.largest_chi.near());
  CHECK(chi >= 0.99 * set.largest_chi.near());
}

TEST_CASE("corrections reach as far from the mean one as covariance and noise may carry them") {
  test::Random random(303);
  Setting set;
  set.q1 = Ball(0.002);
  set.q2 = Ball(0.003);
  set.r = Ball(0.05);
  set.lower = {Ball(0.01), Ball(0.02), Ball(0.002), Ball(0.01)};
  set.upper = {Ball(0.03), Ball(0.05), Ball(0.01), Ball(0.02)};
  for (const double noise : {0.0, 0.1}) {
    CAPTURE(noise);
    set.noise = Ball(noise);
    std::array<double, 2> nearest{};
    for (int k = 0; k < 400; ++k) {
      const double a = random.uniform(-0.3, 0.3);
      const double chi = random.uniform(-1.0, 1.0);
      const Correction<Ball> c = correction(set, Ball(a), Ball(chi));
      for (int i = 0; i < 40; ++i) {
        // A covariance between the bounds, and noise of any direction.
        const Ball share(i % 3 == 0 ? 0.0 : i % 3 == 1 ? 1.0 : random.uniform());
        const auto mix = [&](const Ball& low, const Ball& high) { return low + share * (high - low); };
        const Covariance<Ball> p{mix(set.lower.p11, set.upper.p11), mix(set.lower.p22, set.upper.p22),
                                 mix(set.lower.p23, set.upper.p23), mix(set.lower.p33, set.upper.p33)};
        const Update<Ball> gains = update(set, p, Ball(1.0 + a));
        const double angle = random.uniform(-3.2, 3.2);
        const double z1 =
            1.0 + a + gains.amplitude.near() * (std::cos(chi) - 1.0 - a + noise * std::cos(angle));
        const double z2 = gains.phase.near() * (-std::sin(chi) + noise * std::sin(angle));
        const std::array<double, 2> way{std::fabs(z1 - c.mean[0].near()), std::fabs(z2 - c.mean[1].near())};
        for (std::size_t j = 0; j < 2; ++j) {
          CHECK(way[j] <= c.reach[j].near() * (1.0 + 1e-12));
          nearest[j] = std::max(nearest[j], way[j] / c.reach[j].near());
        }
      }
    }
    CHECK(nearest[0] > 0.7);
    CHECK(nearest[1] > 0.7);
  }
}
