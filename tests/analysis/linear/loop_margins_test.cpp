#include "analysis/linear/loop_margins.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/random.hpp"

namespace veritrack::linear {
namespace {

using rigor::Interval;

/// theta' = theta + w + kp d, w' = w + ki d with d = phase - theta.
DetectorLoop loop_of(double kp, double ki) {
  return {{{Interval(1.0 - kp), Interval(1.0)}, {Interval(-ki), Interval(1.0)}},
          {Interval(kp), Interval(ki)},
          {Interval(1.0), Interval(0.0)}};
}

/// Whether errors decay with d so many samples late, whose last values are states.
bool decays_with_delay(double kp, double ki, int delay) {
  const Eigen::Index n = 2 + delay;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  a(0, 0) = a(0, 1) = a(1, 1) = 1.0;
  const Eigen::Index oldest = delay == 0 ? 0 : n - 1;  // -d of the sample in question
  a(0, oldest) -= kp;
  a(1, oldest) -= ki;
  for (Eigen::Index i = 2; i < n; ++i) {
    a(i, i == 2 ? 0 : i - 1) = 1.0;
  }
  constexpr int kDoublings = 22;
  for (int i = 0; i < kDoublings && a.norm() < 1e50; ++i) {
    a = (a * a).eval();
  }
  return a.norm() < 1e-3;
}

TEST_CASE("the gain of a loop of first order: 1 - k g is inside the circle for 0 < k < 2/g") {
  const double gain = 0.25;
  const DetectorLoop loop{{{Interval(1.0 - gain)}}, {Interval(gain)}, {Interval(1.0)}};
  const GainMargin margin = gain_margin(loop);
  CHECK(margin.low == 0.0);
  CHECK(margin.high == doctest::Approx(2.0 / gain).epsilon(1e-6));
}

TEST_CASE("the delay of a loop of first order, in closed form") {
  // L = g/(z - 1) has the gain 1 at 2 asin(g/2), and there the phase -(pi + w)/2.
  for (const double gain : {0.5, 0.1, 0.001}) {
    const DetectorLoop loop{{{Interval(1.0 - gain)}}, {Interval(gain)}, {Interval(1.0)}};
    const auto margin = delay_margin(loop);
    REQUIRE(margin.has_value());
    const double crossover = 2.0 * std::asin(0.5 * gain);
    CHECK(margin->crossover == doctest::Approx(crossover).epsilon(1e-9));
    CHECK(margin->phase == doctest::Approx(0.5 * (std::numbers::pi - crossover)).epsilon(1e-9));
    CHECK(margin->samples == doctest::Approx(margin->phase / crossover).epsilon(1e-9));
  }
}

TEST_CASE("2 kp - ki < 4 at -1, and delays of whole samples are stable below the margin and not above it") {
  test::Random random;
  for (int trial = 0; trial < 40; ++trial) {
    const double kp = random.uniform(0.02, 0.8);
    const double ki = random.uniform(0.05, 0.6) * kp * kp;
    const DetectorLoop loop = loop_of(kp, ki);
    CHECK(gain_margin(loop).high == doctest::Approx(4.0 / (2.0 * kp - ki)).epsilon(1e-4));
    const auto margin = delay_margin(loop);
    REQUIRE(margin.has_value());
    const int stable = static_cast<int>(std::ceil(margin->samples)) - 1;
    if (stable > 40) {
      continue;
    }
    CHECK(decays_with_delay(kp, ki, stable));
    CHECK_FALSE(decays_with_delay(kp, ki, stable + 1));
  }
}

}  // namespace
}  // namespace veritrack::linear
