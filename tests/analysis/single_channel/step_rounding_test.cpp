#include "analysis/single_channel/step_rounding.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tests/trackers/random_tracker.hpp"
#include "tests/trackers/single_channel_twin.hpp"

namespace veritrack::single_channel {
namespace {

using rigor::Interval;
using sets::StateDifference;

trackers::ToneModel<Interval> model_of(const test::SingleChannelValues& values) {
  return {Interval(values.q1), Interval(values.q2), Interval(values.r), Interval(0.0)};
}

HeldStates held(const test::StateLimits& limits) {
  return {Interval(limits.z), Interval::from_bounds(limits.least_m, limits.most_m), Interval(limits.u),
          Interval::from_bounds(limits.least_d, limits.most_d)};
}

/// Of five designs and boxes of states over decades.
test::StateLimits random_limits(test::Random& random, double spread) {
  test::StateLimits limits;
  limits.z = random.uniform(0.5, 1.3);
  limits.frequency = 3.2;
  limits.least_m = test::random_power(random, -3.0, 0.0);
  limits.most_m = (1.0 + spread) * limits.least_m;
  limits.u = random.uniform(0.1, 5.0);
  limits.least_d = test::random_power(random, -3.0, 0.0);
  limits.most_d = (1.0 + spread) * limits.least_d;
  return limits;
}

TEST_CASE("no step in double differs from its long double twin by more than the bound") {
  test::Random random(7120);
  constexpr double kMeasurement = 1.4;
  for (const double amplitude : {1.0, 0x1p-30, 3e7}) {
    for (const double spread : {1e-6, 1.0, 10.0}) {
      StateDifference largest;
      for (std::int64_t trial = 0; trial < std::max<std::int64_t>(8, test::effort(8)); ++trial) {
        const test::SingleChannelValues values{test::random_power(random, -4.0, 0.0),
                                               test::random_power(random, -4.0, 0.0),
                                               test::random_power(random, -3.0, 1.0)};
        const test::StateLimits limits = random_limits(random, spread);
        const StateDifference bound = [&] {
          const rigor::UpwardRounding upward;
          return step_difference({model_of(values), Interval(amplitude), kMeasurement, limits.frequency},
                                 held(limits));
        }();
        REQUIRE(sets::is_finite(bound));
        for (int i = 0; i < 60; ++i) {
          const auto found = test::twin_difference(
              test::in_unit(values, amplitude), test::in_unit(test::random_state(random, limits), amplitude),
              amplitude * random.uniform(-kMeasurement, kMeasurement));
          largest = sets::larger(largest, {found.z / amplitude / bound.z, found.frequency / bound.frequency,
                                           found.p_zz / (amplitude * amplitude) / bound.p_zz,
                                           found.p_z3 / amplitude / bound.p_z3, found.p_33 / bound.p_33});
        }
      }
      MESSAGE("spread " << spread << ", amplitude " << amplitude << ": shares z " << largest.z
                        << ", frequency " << largest.frequency << ", P_zz " << largest.p_zz << ", P_z3 "
                        << largest.p_z3 << ", P_33 " << largest.p_33);
      for (const double share : {largest.z, largest.frequency, largest.p_zz, largest.p_z3, largest.p_33}) {
        CHECK(share <= 1.0);
        // A bound much larger than what happens would hide that an operation has been left out.
        CHECK(share >= 1e-4);
      }
    }
  }
}

TEST_CASE("in the metric of the covariance the difference is below its two bounds") {
  test::Random random(7121);
  for (std::int64_t trial = 0; trial < test::effort(20); ++trial) {
    const test::SingleChannelValues values{test::random_power(random, -3.0, 0.0),
                                           test::random_power(random, -3.0, 0.0),
                                           test::random_power(random, -2.0, 1.0)};
    const test::StateLimits limits = random_limits(random, 1.0);
    const StepRounding bound = [&] {
      const rigor::UpwardRounding upward;
      const auto model = model_of(values);
      return in_metric(model, step_difference({model, Interval(1.0), 1.5, limits.frequency}, held(limits)));
    }();
    REQUIRE(bound.is_bounded());
    for (int i = 0; i < 60; ++i) {
      const auto found =
          test::twin_difference(values, test::random_state(random, limits), random.uniform(-1.5, 1.5));
      CHECK(found.covariance <= bound.covariance);
      CHECK(found.error <= bound.error);
    }
  }
}

TEST_CASE("the metric: every error and every change of P of that size, for the least covariance") {
  const rigor::UpwardRounding upward;
  const trackers::ToneModel<Interval> model = model_of({0.5, 0.04, 0.5});
  CHECK(rigor::is_subset(Interval(0.25), filtered_floor(model)));
  // P = diag(1/4, 1/4, 0.04): its own share, of each block alone and of all three along x = (2, 0, 5).
  const auto share = [&](double zz, double z3, double d33) {
    return in_metric(model, {0.0, 0.0, zz, z3, d33}).covariance;
  };
  CHECK(share(0.25e-3, 0.0, 0.0) == doctest::Approx(1e-3));
  CHECK(share(0.0, 0.0, 0.04e-3) == doctest::Approx(1e-3));
  CHECK(share(0.0, 0.1e-3, 0.0) == doctest::Approx(1e-3));
  CHECK(share(0.25e-3, 0.1e-3, 0.04e-3) == doctest::Approx(2e-3));
  const StepRounding error = in_metric(model, {0.3, 0.16, 0.25e-3, 0.0, 0.0});
  CHECK(error.error == doctest::Approx(std::sqrt((0.36 + 0.64) / 0.999)));
  CHECK(in_metric(model, {0.3, 0.4, 1e-3, 0.0, 0.0}).is_bounded() == false);  // above a 256th
  CHECK_FALSE(in_metric(model, {std::nan(""), 0.0, 0.0, 0.0, 0.0}).is_bounded());
  CHECK_FALSE(in_metric(model_of({0.0, 0.04, 0.5}), {0.0, 0.0, 0.0, 0.0, 0.0}).is_bounded());
  CHECK_FALSE(in_metric(model_of({0.5, 0.0, 0.5}), {0.0, 0.0, 0.0, 0.0, 0.0}).is_bounded());
}

TEST_CASE("nothing is bounded where something is unknown, or beyond the units of length that are admitted") {
  const rigor::UpwardRounding upward;
  const auto bounded = [](const test::SingleChannelValues& values, const Interval& amplitude,
                          double measurement, double frequency, const HeldStates& states) {
    return sets::is_finite(step_difference({model_of(values), amplitude, measurement, frequency}, states));
  };
  const HeldStates box{Interval(1.1), Interval::from_bounds(0.01, 0.1), Interval(2.0),
                       Interval::from_bounds(0.01, 0.02)};
  const test::SingleChannelValues usual{0.01, 0.01, 0.1};
  const Interval one(1.0);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK(bounded(usual, one, 1.0, 3.0, box));
  CHECK_FALSE(bounded(usual, Interval(0x1p-61), 1.0, 3.0, box));
  CHECK_FALSE(bounded(usual, Interval(0x1p61), 1.0, 3.0, box));
  CHECK_FALSE(bounded(usual, Interval::empty(), 1.0, 3.0, box));
  CHECK_FALSE(bounded(usual, one, kNan, 3.0, box));
  CHECK_FALSE(bounded(usual, one, 1.0, kNan, box));
  CHECK_FALSE(bounded({0.01, 0.01, 0.0}, one, 1.0, 3.0, box));
  CHECK_FALSE(bounded({-1e-3, 0.01, 0.1}, one, 1.0, 3.0, box));
  CHECK_FALSE(bounded({0.01, 0.0, 0.1}, one, 1.0, 3.0, box));
  const auto changed = [&](Interval HeldStates::*member, const Interval& value) {
    HeldStates states = box;
    states.*member = value;
    return bounded(usual, one, 1.0, 3.0, states);
  };
  for (Interval HeldStates::*member :
       {&HeldStates::z, &HeldStates::eigenvalues, &HeldStates::u, &HeldStates::d}) {
    CHECK_FALSE(changed(member, Interval::empty()));
    CHECK_FALSE(changed(member, Interval::entire()));
    CHECK_FALSE(changed(member, Interval(1e300)));
  }
  CHECK_FALSE(changed(&HeldStates::eigenvalues, Interval::from_bounds(-1e-3, 0.1)));
  CHECK_FALSE(changed(&HeldStates::d, Interval::from_bounds(0.0, 0.1)));
}

}  // namespace
}  // namespace veritrack::single_channel
