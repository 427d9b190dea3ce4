// The static map in double beside its twin in long double, and the cases in which nothing is known.
#include "checker/kkl_observer/rounded_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "checker/numbers/rounded_value.hpp"
#include "tests/support/random.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace {

using namespace veritrack;
using checker::Ball;
using checker::FilterStates;
using Long = long double;

const Eigen::Vector4d kRates(1.0, 2.0, 3.0, 4.0);
constexpr double kEll = 3e-4;
constexpr double kLargestEll = 1e-3;
constexpr double kLeastAmplitude = 0.3;

FilterStates states_of(double low, double high) {
  FilterStates states{
      {}, Ball(kEll), Ball(kLargestEll), Ball(low * low), Ball(high * high), Ball(kLeastAmplitude)};
  for (const double rate : kRates) {
    states.lambda.emplace_back(rate);
  }
  return states;
}

bool is_bounded(const FilterStates& states) {
  const checker::MapRounding found = map_rounding(states);
  return found.frequency.finite() && found.amplitude.finite();
}

}  // namespace

TEST_CASE("the map's twin stays within the bounds, at any scale") {
  test::Random random(291);
  const checker::MapRounding proved = map_rounding(states_of(1.9, 4.1));
  const trackers::KklObserverDesign<double, 4> design{kRates, kEll};
  const trackers::KklObserverDesign<Long, 4> twin{kRates.cast<Long>(), static_cast<Long>(kEll)};
  double frequency = 0.0;
  double amplitude = 0.0;
  for (std::int64_t i = 0; i < test::effort(20'000); ++i) {
    const double scale = std::exp2(random.uniform(-200.0, 200.0));
    Eigen::Vector4d xi = trackers::kkl_transform<double, 4>(
        trackers::oscillator_state(scale, random.uniform(0.0, 6.3), random.uniform(2.0, 4.0)), kRates);
    for (double& state : xi) {
      state += 1e-4 * scale * random.uniform(-1.0, 1.0);
    }
    const Eigen::Matrix<Long, 4, 1> same = xi.cast<Long>();
    const Long norm = std::sqrt(same.squaredNorm());
    const auto state = trackers::kkl_inverse<Long, 4>(same, twin);
    const auto exact = trackers::in_engineering_units(state);
    const Long excitation = trackers::kkl_excitation<Long, 4>(same, twin.lambda) / (norm * norm);
    if (!(2.0L * excitation >= kLargestEll && exact.frequency > 1.9L && exact.frequency < 4.1L &&
          exact.amplitude >= kLeastAmplitude * norm)) {
      continue;
    }
    const auto computed = trackers::in_engineering_units(trackers::kkl_inverse<double, 4>(xi, design));
    frequency = std::max(frequency, static_cast<double>(std::fabs(computed.frequency - exact.frequency)));
    amplitude =
        std::max(amplitude, static_cast<double>(std::fabs(computed.amplitude - exact.amplitude) / norm));
  }
  CHECK(frequency > 0.0);
  CHECK(frequency <= proved.frequency.near());
  CHECK(amplitude <= proved.amplitude.near());
  CHECK(proved.frequency.near() < 1000.0 * frequency);
  CHECK(proved.amplitude.near() < 1e5 * amplitude);
}

TEST_CASE("no bound where mu may be computed as more than zero, or where too little is known") {
  CHECK(is_bounded(states_of(2.0, 4.0)));
  FilterStates states = states_of(2.0, 4.0);
  states.ell = states.largest_ell;
  CHECK_FALSE(is_bounded(states));
  states.ell = Ball::everything();
  CHECK_FALSE(is_bounded(states));
  states = states_of(2.0, 4.0);
  states.largest_ell = Ball(1e-14);
  states.ell = Ball(1e-15);
  CHECK_FALSE(is_bounded(states));  // the last pivot may be lost
  states.largest_ell = Ball(-1.0);
  states.ell = Ball(-2.0);
  CHECK_FALSE(is_bounded(states));
  states = states_of(0.0, 4.0);
  CHECK_FALSE(is_bounded(states));
  states = states_of(2.0, 4.0);
  states.most_square = Ball::everything();
  CHECK_FALSE(is_bounded(states));
  states = states_of(2.0, 4.0);
  states.least_amplitude = checker::zero;
  CHECK_FALSE(is_bounded(states));
  CHECK(map_rounding(states).frequency.finite());
  states.least_amplitude = Ball(1e9);  // more than there can be
  CHECK_FALSE(is_bounded(states));
}

TEST_CASE("each operation's error: operands at the ends of their bounds") {
  using checker::RoundedValue;
  constexpr double kUlp = 0x1p-52;
  const RoundedValue x{Ball(3.0), Ball(1e-9)};
  const RoundedValue y{Ball(0.5), Ball(2e-9)};
  CHECK((x + y).error.near() >= 3e-9);
  CHECK((x * y).error.near() >= 3.0 * 2e-9 + 0.5 * 1e-9);
  CHECK((x * y).error.near() <= 6.6e-9);
  // 3 / (0.25 - 2e-9) against 3 / 0.25.
  const RoundedValue over = quotient(x, y, Ball(0.25), Ball(12.0));
  CHECK(over.error.near() >= 3.0 / (0.25 - 2e-9) - 12.0);
  CHECK(over.error.near() <= 1.1e-7);
  const RoundedValue zero_inside = quotient(x, {Ball(0.5), Ball(0.3)}, Ball(0.25), Ball(12.0));
  CHECK_FALSE(zero_inside.error.finite());
  const RoundedValue root_of = root({Ball(4.0), Ball(0.75)}, Ball(1.0));
  CHECK(root_of.error.near() >= 0.5);
  CHECK(root_of.error.near() <= 0.51);
  CHECK_FALSE(root({Ball(4.0), Ball(1.5)}, Ball(1.0)).error.finite());
  CHECK(rounded(checker::one, checker::zero).error.near() >= 0.5 * kUlp);
  CHECK_FALSE(rounded(Ball(0x1p541), checker::zero).error.finite());
}
