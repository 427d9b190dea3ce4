// The bounds on the errors of the estimates against the observer that runs.
#include "checker/kkl_observer/signal_cells.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace {

using namespace veritrack;
using checker::Ball;

constexpr double kFrequency = 3.0;
constexpr double kAmplitude = 2.0;
constexpr double kSettlingTime = 14.0;
const Eigen::Vector4d kLambda(1.0, 2.0, 3.0, 4.0);

checker::KklDesign design() {
  checker::KklDesign design;
  for (const double rate : kLambda) {
    design.lambda.emplace_back(rate);
  }
  design.frequency_low = design.frequency_high = Ball(kFrequency);
  design.amplitude_low = design.amplitude_high = Ball(kAmplitude);
  return design;
}
/// What can go wrong with the estimates.
struct Errors {
  double frequency = 0.0, amplitude = 0.0, least_square = HUGE_VAL, least_ratio = HUGE_VAL;

  /// Of the observer with filters at the signal's steady state plus `moves`.
  void look(double phase, const Eigen::Vector4d& moves) {
    constexpr double kSmallEll = 1e-9;
    const auto x = trackers::oscillator_state(kAmplitude, phase, kFrequency);
    const Eigen::Vector4d xi = trackers::kkl_transform<double, 4>(x, kLambda) + moves;
    const auto found = trackers::kkl_inverse<double, 4>(xi, {kLambda, kSmallEll});
    const auto estimate = trackers::in_engineering_units(found);
    frequency = std::max(frequency, std::fabs(estimate.frequency - kFrequency));
    amplitude = std::max(amplitude, std::fabs(estimate.amplitude - kAmplitude));
    least_square = std::min(least_square, found(2) / x(2));
    least_ratio =
        std::min(least_ratio, 2.0 * trackers::kkl_excitation<double, 4>(xi, kLambda) / xi.squaredNorm());
  }
};

/// What is left of the signal's start.
Eigen::Vector4d random_rest(test::Random& random) {
  Eigen::Vector4d rest;
  for (int i = 0; i < 4; ++i) {
    rest(i) = random.uniform(-1.0, 1.0) * std::exp(-kLambda(i) * kSettlingTime) * kAmplitude /
              std::hypot(kLambda(i), kFrequency);
  }
  return rest;
}

/// All bounds are proved with room to spare, and none that was seen broken.
void check_bounds(const checker::KklDesign& design, const Errors& seen, double room) {
  using checker::SignalCells;
  const SignalCells cells(design, Ball(kSettlingTime));
  const auto is_proved = [&](auto statement, double bound) {
    return cells.always([&](const checker::KklCell& cell) { return (cells.*statement)(cell, Ball(bound)); });
  };
  CHECK(is_proved(&SignalCells::frequency_error_at_most, room * seen.frequency));
  CHECK(is_proved(&SignalCells::amplitude_error_at_most, 1.1 * room * seen.amplitude));
  CHECK(is_proved(&SignalCells::relative_square_at_least, 1.0 - room * (1.0 - seen.least_square)));
  CHECK(is_proved(&SignalCells::ratio_at_least, seen.least_ratio / room));
  CHECK(!is_proved(&SignalCells::frequency_error_at_most, 0.95 * seen.frequency));
  CHECK(!is_proved(&SignalCells::amplitude_error_at_most, 0.95 * seen.amplitude));
  CHECK(!is_proved(&SignalCells::relative_square_at_least, 1.0 - 0.95 * (1.0 - seen.least_square)));
  CHECK(!is_proved(&SignalCells::ratio_at_least, seen.least_ratio / 0.95));
}

}  // namespace

TEST_CASE("a sinusoid of any phase, from its lowest frequency up") {
  test::Random random(141);
  constexpr double kDisturbance = 0.2;
  constexpr double kLowest = 100.0;
  Errors seen;
  for (std::int64_t i = 0; i < test::effort(40'000); ++i) {
    const auto other = trackers::oscillator_state(kDisturbance, random.uniform(0.0, 6.3),
                                                  kLowest * (1.0 + 0.1 * std::pow(random.uniform(), 4.0)));
    seen.look(random.uniform(0.0, 6.3),
              trackers::kkl_transform<double, 4>(other, kLambda) + random_rest(random));
  }
  checker::KklDesign disturbed = design();
  disturbed.disturbance_amplitude = Ball(kDisturbance);
  disturbed.disturbance_frequency = Ball(kLowest);
  check_bounds(disturbed, seen, 1.1);
}

TEST_CASE(
    "a disturbance of which only a bound is known: the worst on-off input for many functions of the "
    "filters") {
  test::Random random(142);
  constexpr double kBound = 0.002;
  constexpr double kStep = 0.02;
  Errors seen;
  for (std::int64_t i = 0; i < test::effort(3'000); ++i) {
    // A combination of the filters orthogonal to 1 and lambda is what the frequency sees.
    const double turn = random.uniform(0.0, 6.3);
    const Eigen::Vector4d weights = std::cos(turn) * Eigen::Vector4d(-1.0, 2.0, -1.0, 0.0) +
                                    std::sin(turn) * Eigen::Vector4d(0.0, -1.0, 2.0, -1.0);
    const Eigen::Vector4d driven = weights.cwiseProduct(kLambda.cwiseProduct(kLambda).array().matrix() +
                                                        Eigen::Vector4d::Constant(kFrequency * kFrequency));
    Eigen::Vector4d moves = Eigen::Vector4d::Zero();
    for (double t = 0.5 * kStep; t < 12.0; t += kStep) {
      const Eigen::Vector4d kernel = (-kLambda * t).array().exp();
      moves += (driven.dot(kernel) > 0.0 ? kBound : -kBound) * kStep * kernel;
    }
    for (int k = 0; k < 20; ++k) {
      seen.look(random.uniform(0.0, 6.3), moves + random_rest(random));
    }
  }
  checker::KklDesign disturbed = design();
  disturbed.bound = Ball(kBound);
  check_bounds(disturbed, seen, 1.25);
}

TEST_CASE("without a disturbance, what is left of the start") {
  using checker::SignalCells;
  const SignalCells cells(design(), Ball(kSettlingTime));
  const auto is_proved = [&](double bound) {
    return cells.always(
        [&](const checker::KklCell& cell) { return cells.frequency_error_at_most(cell, Ball(bound)); });
  };
  test::Random random(143);
  Errors seen;
  for (std::int64_t i = 0; i < test::effort(5'000); ++i) {
    seen.look(random.uniform(0.0, 6.3), random_rest(random));
  }
  CHECK(is_proved(1.5 * seen.frequency));
  CHECK(!is_proved(0.95 * seen.frequency));
}
