#include "analysis/single_channel/window_rounding.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/trackers/single_channel_twin.hpp"

namespace veritrack::single_channel {
namespace {

using rigor::Interval;

const Interval kRoundedBand = Interval::from_bounds(0.4, 2.7);

struct RoundedWindow {
  test::SingleChannelValues values;
  WindowAssumption assumption;
};

/// The examples of the paper with Q = q I, and about what their windows assume.
std::array<RoundedWindow, 3> rounded_windows() {
  return {{{{0.005, 0.005, 0.01}, {0.026, 0.0228, 0.114, 0.025}},
           {{1.0, 1.0, 1.0}, {0.0019, 4.29, 19.1, 0.025}},
           {{1.0, 1.0, 10.0}, {0.0017, 5.47, 40.9, 0.025}}}};
}

trackers::ToneModel<Interval> model_of_window(const test::SingleChannelValues& values) {
  return {Interval(values.q1), Interval(values.q2), Interval(values.r), Interval(0.0)};
}

StepRounding rounding_of(const RoundedWindow& one, double noise,
                         const std::optional<StartRange>& start = {}) {
  const rigor::UpwardRounding upward;
  return window_rounding(model_of_window(one.values), {Interval(1.0), kRoundedBand, Interval(noise)},
                         one.assumption, start);
}

TEST_CASE("no step from a state of the window differs from its twin by more") {
  test::Random random(7130);
  for (const RoundedWindow& one : rounded_windows()) {
    const StepRounding bound = rounding_of(one, 0.01);
    REQUIRE(bound.is_bounded());
    const double a = one.assumption.frequency_variance;
    const double b = one.assumption.signal_variance;
    const double floor = one.values.q1 * one.values.r / (one.values.q1 + one.values.r);
    test::TwinDifference largest;
    for (std::int64_t i = 0; i < test::effort(2000); ++i) {
      test::StateLimits limits;
      limits.z = 1.0 + one.assumption.radius * std::sqrt(b);
      limits.frequency = 2.7 + one.assumption.radius * std::sqrt(a);
      limits.least_d = limits.most_d = random.uniform(one.values.q2, a);
      limits.u = random.uniform() * std::sqrt((b - floor) / limits.most_d);
      // P_zz = M + d u u' is at most b.
      limits.least_m = floor;
      limits.most_m = b - limits.most_d * limits.u * limits.u;
      const auto found =
          test::twin_difference(one.values, test::random_state(random, limits), random.uniform(-1.01, 1.01));
      CHECK(found.error <= bound.error);
      CHECK(found.covariance <= bound.covariance);
      largest.error = std::max(largest.error, found.error);
      largest.covariance = std::max(largest.covariance, found.covariance);
    }
    MESSAGE("r = " << one.values.r << ": error " << bound.error << ", twin " << largest.error
                   << "; covariance " << bound.covariance << ", twin " << largest.covariance);
  }
}

TEST_CASE("a range of starts is covered, and grows the bound only when its states do more") {
  const RoundedWindow one = rounded_windows()[0];
  const StepRounding without = rounding_of(one, 0.0);
  const auto with = [&](double low, double high) {
    const rigor::UpwardRounding upward;
    return rounding_of(one, 0.0,
                       StartRange{{Interval(low), Interval(1e-3)}, {Interval(high), Interval(1.1e-3)}});
  };
  CHECK(with(1e-3, 1.1e-3).error == without.error);
  CHECK(with(1e-3, 1e3).error > without.error);
  CHECK_FALSE(with(-1e-3, 1e-3).is_bounded());
  CHECK_FALSE(with(2e-3, 1e-3).is_bounded());  // a range from a larger matrix to a smaller one
  const rigor::UpwardRounding upward;
  CHECK_FALSE(
      rounding_of(one, 0.0, StartRange{{Interval(1e-3), Interval(0.0)}, {Interval(1e-3), Interval(1e-3)}})
          .is_bounded());
}

TEST_CASE("what is not known is not bounded") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK(rounding_of(rounded_windows()[0], 1e-3).is_bounded());
  CHECK(rounding_of(rounded_windows()[0], 1e3).error > rounding_of(rounded_windows()[0], 1e-3).error);
  for (double WindowAssumption::*member : {&WindowAssumption::radius, &WindowAssumption::frequency_variance,
                                           &WindowAssumption::signal_variance}) {
    for (const double odd : {kNan, std::numeric_limits<double>::infinity(), -1.0, 1e250}) {
      RoundedWindow one = rounded_windows()[0];
      one.assumption.*member = member == &WindowAssumption::radius && odd < 0.0 ? kNan : odd;
      CHECK_FALSE(rounding_of(one, 0.0).is_bounded());
    }
  }
  CHECK_FALSE(rounding_of(rounded_windows()[0], kNan).is_bounded());
  const rigor::UpwardRounding upward;
  const RoundedWindow one = rounded_windows()[0];
  CHECK_FALSE(window_rounding(model_of_window(one.values), {Interval(0x1p-70), kRoundedBand}, one.assumption)
                  .is_bounded());
  CHECK_FALSE(
      window_rounding(model_of_window(one.values), {Interval(1.0), Interval::entire()}, one.assumption)
          .is_bounded());
}

}  // namespace
}  // namespace veritrack::single_channel
