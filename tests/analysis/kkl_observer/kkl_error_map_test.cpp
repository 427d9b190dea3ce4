#include "analysis/kkl_observer/kkl_error_map.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "analysis/rigor/matrix.hpp"
#include "tests/support/random.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {
namespace {

using Map = KklErrorMap<double>;
using rigor::Interval;

struct Case {
  Eigen::Vector4d lambda;
  double frequency, phase, amplitude, other_period, other_phase, other_amplitude;
};

Case random_case(test::Random& random) {
  Case c;
  double rate = 0.0;
  for (int i = 0; i < 4; ++i) {
    rate += random.uniform(0.5, 1.5);
    c.lambda(i) = rate;
  }
  c.frequency = random.uniform(0.8, 4.0);
  c.phase = random.uniform(0.0, 2.0 * std::numbers::pi);
  c.amplitude = random.uniform(0.5, 3.0);
  c.other_period = 1.0 / random.uniform(10.0, 200.0);
  c.other_phase = random.uniform(0.0, 2.0 * std::numbers::pi);
  c.other_amplitude = 0.01 * c.amplitude * random.uniform();
  return c;
}

TEST_CASE("the errors are those of gamma itself, at filters moved by a second sinusoid") {
  test::Random random(21);
  for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
    CAPTURE(trial);
    const Case c = random_case(random);
    const Map map(c.lambda);
    const auto at = map.signal(c.frequency, c.phase);
    const auto response = map.response(at, c.other_period, c.other_phase);
    Map::Filters<double> u;
    Eigen::Vector4d xi = trackers::kkl_transform<double, 4>(
        trackers::oscillator_state(c.amplitude, c.phase, c.frequency), c.lambda);
    const Eigen::Vector4d other = trackers::kkl_transform<double, 4>(
        trackers::oscillator_state(c.other_amplitude, c.other_phase, 1.0 / c.other_period), c.lambda);
    xi += other;
    for (std::size_t i = 0; i < 4; ++i) {
      u[i] = response.filters[i] * c.other_amplitude / c.amplitude;
      CHECK(u[i] == doctest::Approx(other(static_cast<Eigen::Index>(i)) / c.amplitude));
    }
    const auto x = trackers::kkl_inverse<double, 4>(xi, {c.lambda, 0.0});
    const auto estimate = trackers::in_engineering_units(x);
    const auto y = map.perturbed(at, u);
    const double squared = map.squared_frequency_error(at, u, y);
    CHECK(squared == doctest::Approx(x(2) - c.frequency * c.frequency).epsilon(1e-4).scale(0.01));
    CHECK(Map::frequency_error(at, squared) ==
          doctest::Approx(estimate.frequency - c.frequency).epsilon(1e-4).scale(0.01));
    CHECK(map.amplitude_error(at, u, squared) ==
          doctest::Approx(estimate.amplitude / c.amplitude - 1.0).epsilon(1e-4).scale(0.01));
    CHECK(
        map.excitation_ratio(at, u, y) ==
        doctest::Approx(trackers::kkl_excitation<double, 4>(xi, c.lambda) / xi.squaredNorm()).epsilon(1e-6));
    // The closed forms for a sinusoid say the same.
    double product = 0.0;
    double norm = 0.0;
    for (std::size_t j = 0; j < 2; ++j) {
      const double share = c.other_amplitude / c.amplitude;
      CHECK(at.projected[j] + share * response.projected[j] == doctest::Approx(y[j]).epsilon(1e-7));
      product += y[j] * share * response.pull[j];
      norm += y[j] * y[j];
    }
    CHECK(product / norm == doctest::Approx(squared).epsilon(1e-5).scale(1e-3));
  }
}

TEST_CASE("interval errors hold those in double") {
  test::Random random(22);
  for (std::int64_t trial = 0; trial < test::effort(100); ++trial) {
    CAPTURE(trial);
    const Case c = random_case(random);
    const Map map(c.lambda);
    const auto at = map.signal(c.frequency, c.phase);
    Map::Filters<double> u;
    KklErrorMap<Interval>::Filters<Interval> wide;
    for (std::size_t i = 0; i < 4; ++i) {
      u[i] = random.uniform(-1e-4, 1e-4);
      wide[i] = Interval::from_bounds(u[i] - 1e-5, u[i] + 1e-5);
    }
    const double squared = map.squared_frequency_error(at, u, map.perturbed(at, u));
    const double amplitude = map.amplitude_error(at, u, squared);
    const rigor::UpwardRounding upward;
    const KklErrorMap<Interval> enclosing(rigor::to_interval(c.lambda));
    const auto cell = enclosing.signal(Interval::from_bounds(c.frequency - 1e-6, c.frequency + 1e-6),
                                       Interval::from_bounds(c.phase - 1e-6, c.phase + 1e-6));
    const Interval enclosed = enclosing.squared_frequency_error(cell, wide, enclosing.perturbed(cell, wide));
    CHECK(rigor::contains(enclosed, squared));
    CHECK(rigor::contains(enclosing.amplitude_error(cell, wide, enclosed), amplitude));
  }
}

}  // namespace
}  // namespace veritrack::kkl_observer
