// The checker's bound on rounding against the single-channel tracker that runs, beside its twin in long
// double.
#include "checker/single_channel/rounded_step.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/trackers/random_tracker.hpp"
#include "tests/trackers/single_channel_twin.hpp"

namespace {

using namespace veritrack;
using checker::Ball;

checker::SingleChannelDesign design_of(const test::SingleChannelValues& values, double amplitude = 1.0) {
  checker::SingleChannelDesign design;
  design.amplitude = Ball(amplitude);
  design.q1 = Ball(values.q1);
  design.q2 = Ball(values.q2);
  design.r = Ball(values.r);
  design.epsilon = Ball(0.0);
  design.lowest = Ball(0.4);
  design.highest = Ball(2.7);
  return design;
}

checker::HeldTone held(const test::StateLimits& limits, double measurement) {
  return {Ball(limits.z),      Ball(limits.frequency), Ball(measurement),    Ball(limits.least_m),
          Ball(limits.most_m), Ball(limits.u),         Ball(limits.least_d), Ball(limits.most_d)};
}

checker::WindowStatement window_of(double radius, double a, double b) {
  checker::WindowStatement window;
  window.radius = Ball(radius);
  window.frequency_variance = Ball(a);
  window.signal_variance = Ball(b);
  return window;
}

checker::DiagonalStart start_of(double signal, double frequency, double from, double to) {
  return {Ball(signal), Ball(frequency), Ball(from), Ball(to), ""};
}

}  // namespace

TEST_CASE("no step in double differs from its long double twin by more than the bound") {
  test::Random random(7140);
  for (const double amplitude : {1.0, 0x1p-25, 5e6}) {
    double largest = 0.0;
    double smallest = 1.0;
    for (std::int64_t trial = 0; trial < test::effort(20); ++trial) {
      const test::SingleChannelValues values{test::random_power(random, -4.0, 0.0),
                                             test::random_power(random, -4.0, 0.0),
                                             test::random_power(random, -3.0, 1.0)};
      test::StateLimits limits;
      limits.z = random.uniform(0.5, 1.3);
      limits.frequency = 3.2;
      limits.least_m = test::random_power(random, -3.0, 0.0);
      limits.most_m = 2.0 * limits.least_m;
      limits.u = random.uniform(0.1, 5.0);
      limits.least_d = test::random_power(random, -3.0, 0.0);
      limits.most_d = 2.0 * limits.least_d;
      const checker::ToneRounding bound = rounded_step(design_of(values, amplitude), held(limits, 1.4));
      double share = 0.0;
      for (int i = 0; i < 60; ++i) {
        const auto found = test::twin_difference(test::in_unit(values, amplitude),
                                                 test::in_unit(test::random_state(random, limits), amplitude),
                                                 amplitude * random.uniform(-1.4, 1.4));
        share =
            std::max({share, found.z / amplitude / bound.z.near(), found.frequency / bound.frequency.near(),
                      found.p_zz / (amplitude * amplitude) / bound.p_zz.near(),
                      found.p_z3 / amplitude / bound.p_z3.near(), found.p_33 / bound.p_33.near()});
      }
      largest = std::max(largest, share);
      smallest = std::min(smallest, share);
    }
    MESSAGE("amplitude " << amplitude << ": shares from " << smallest << " to " << largest);
    CHECK(largest <= 1.0);
    CHECK(smallest >= 1e-6);
  }
}

TEST_CASE("the states of a window: the share of P, and the error in its metric") {
  test::Random random(7141);
  const test::SingleChannelValues values{0.005, 0.005, 0.01};
  const double a = 0.0228;
  const double b = 0.114;
  const auto bound = step_rounding(design_of(values), window_of(0.026, a, b), Ball(0.01), std::nullopt);
  REQUIRE(bound.finite());
  MESSAGE("error " << bound.error.near() << ", covariance " << bound.covariance.near());
  for (std::int64_t i = 0; i < test::effort(1000); ++i) {
    test::StateLimits limits;
    limits.z = 1.0 + 0.026 * std::sqrt(b);
    limits.frequency = 2.7;
    limits.least_d = limits.most_d = random.uniform(values.q2, a);
    limits.least_m = 1.0 / 300.0;
    limits.u = random.uniform() * std::sqrt((b - limits.least_m) / limits.most_d);
    limits.most_m = b - limits.most_d * limits.u * limits.u;
    const auto found =
        test::twin_difference(values, test::random_state(random, limits), random.uniform(-1.01, 1.01));
    CHECK(found.error <= bound.error.near());
    CHECK(found.covariance <= bound.covariance.near());
  }
}

TEST_CASE("the share of P is for the least covariance, and the error for its metric after rounding") {
  // floor 1/4, q2 = 0.04; what rounded_step says, by hand in the metric.
  const test::SingleChannelValues values{0.5, 0.04, 0.5};
  const checker::SingleChannelDesign design = design_of(values);
  const auto bound = step_rounding(design, window_of(0.01, 0.1, 1.0), Ball(0.0), std::nullopt);
  test::StateLimits limits;
  limits.z = 1.01;
  limits.frequency = 2.7 + 0.01 * std::sqrt(0.1);
  limits.least_m = 255.0 / 1024.0;
  limits.most_m = 1.0;
  limits.least_d = 0.04 * 255.0 / 256.0;
  limits.most_d = 0.1;
  limits.u = std::sqrt(1.0 / limits.least_d);
  const auto step = rounded_step(design, held(limits, 1.0));
  const double z3 = step.p_z3.near();
  const double share = std::max((step.p_zz.near() + 2.5 * z3) / 0.25, (step.p_33.near() + z3 / 2.5) / 0.04);
  CHECK(bound.covariance.near() == doctest::Approx(share));
  CHECK(bound.error.near() == doctest::Approx(std::hypot(step.z.near() / 0.5, step.frequency.near() / 0.2)));
}

TEST_CASE("starts are covered with the rest") {
  const checker::SingleChannelDesign design = design_of({0.005, 0.005, 0.01});
  const auto window = window_of(0.01, 0.0228, 0.114);
  const auto rounding = [&](const std::optional<checker::DiagonalStart>& start) {
    return step_rounding(design, window, Ball(0.0), start);
  };
  const double without = rounding({}).error.near();
  CHECK(rounding(start_of(1e-3, 1e-3, 0.95, 1.05)).error.near() >= without);
  CHECK(rounding(start_of(1e3, 1e-3, 0.95, 1.05)).error.near() > without);
  CHECK_FALSE(rounding(start_of(1e-3, 0.0, 0.95, 1.05)).finite());
  CHECK_FALSE(rounding(start_of(-1e-3, 1e-3, 0.95, 1.05)).finite());
}

TEST_CASE("a share of P that is not small is none") {
  const auto window = window_of(0.01, 0.0228, 0.114);
  for (int power = 5; power <= 15; ++power) {
    const auto found =
        step_rounding(design_of({std::pow(10.0, -power), 0.005, 0.01}), window, Ball(0.0), std::nullopt);
    CHECK((!found.finite() || found.covariance.near() <= 0x1p-8));
    CHECK((power > 6 || found.finite()));
    CHECK((power < 14 || !found.finite()));
  }
  CHECK_FALSE(step_rounding(design_of({0.0, 0.005, 0.01}), window, Ball(0.0), std::nullopt).finite());
}

TEST_CASE("nothing is bounded where something is unknown, or beyond the units of length that are admitted") {
  const test::SingleChannelValues usual{0.01, 0.01, 0.1};
  const test::StateLimits limits{1.1, 3.0, 0.01, 0.1, 2.0, 0.01, 0.02};
  const auto bounded = [](const checker::SingleChannelDesign& design, const checker::HeldTone& states) {
    const auto step = rounded_step(design, states);
    return step.z.finite() && step.frequency.finite() && step.p_zz.finite() && step.p_z3.finite() &&
           step.p_33.finite();
  };
  CHECK(bounded(design_of(usual), held(limits, 1.0)));
  CHECK_FALSE(bounded(design_of(usual, 0x1p-61), held(limits, 1.0)));
  CHECK_FALSE(bounded(design_of(usual, 0x1p61), held(limits, 1.0)));
  CHECK_FALSE(bounded(design_of({0.01, 0.01, 0.0}), held(limits, 1.0)));
  CHECK_FALSE(bounded(design_of({-0.01, 0.01, 0.1}), held(limits, 1.0)));
  CHECK_FALSE(bounded(design_of({0.01, 0.0, 0.1}), held(limits, 1.0)));
  checker::SingleChannelDesign leaking = design_of(usual);
  leaking.epsilon = Ball(0.01);
  CHECK_FALSE(bounded(leaking, held(limits, 1.0)));
  for (Ball checker::HeldTone::*member :
       {&checker::HeldTone::z, &checker::HeldTone::frequency, &checker::HeldTone::measurement,
        &checker::HeldTone::least_m, &checker::HeldTone::most_m, &checker::HeldTone::u,
        &checker::HeldTone::least_d, &checker::HeldTone::most_d}) {
    checker::HeldTone states = held(limits, 1.0);
    states.*member = Ball::everything();
    CHECK_FALSE(bounded(design_of(usual), states));
  }
  test::StateLimits odd = limits;
  odd.least_m = -0.01;
  CHECK_FALSE(bounded(design_of(usual), held(odd, 1.0)));
  odd = limits;
  odd.least_d = 0.0;
  CHECK_FALSE(bounded(design_of(usual), held(odd, 1.0)));
}
