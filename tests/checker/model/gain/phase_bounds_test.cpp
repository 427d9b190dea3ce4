// Bounds of loops with phases against sums that are written out, and against simulations.
#include "checker/model/gain/phase_bounds.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/checker/model/gain/phase_loops.hpp"

namespace veritrack::checker {
namespace {

using test::kHalfBand;
using test::kMeanFrequency;

const std::vector<Ball> kAtSteadyState = {zero};

/// The largest error of w' = 0.9 w + 0.1 y^2 from its steady state, w - omega included, over phases, for the
/// noise that pushes in one direction: 0.1 sum 0.9^k (2 |cos| V + V^2).
double largest_written_out(double noise, double omega) {
  double largest = 0.0;
  for (int at = 0; at < 2000; ++at) {
    const double phase = 3.14159265358979 * 0.001 * at;
    double deviation = 0.0;
    double mean = 0.0;
    for (int k = 0; k < 400; ++k) {
      const double cosine = std::cos(phase - k * omega);
      deviation += 0.1 * std::pow(0.9, k) * (2.0 * std::abs(cosine) * noise + noise * noise);
      mean += 0.1 * std::pow(0.9, k) * cosine * cosine;
    }
    largest = std::max(largest, std::abs(mean - omega) + deviation);
  }
  return largest;
}

double for_ever(const PhaseBounds& bounds, double noise, double slew = 0.0, double start = 0.0) {
  const auto errors = bounds.errors(Ball(noise), Ball(slew), {Ball(start)});
  return errors ? errors->for_ever().upper_double() : HUGE_VAL;
}

}  // namespace

TEST_CASE("The bound of a loop whose gain is known is a little above the sum that is written out") {
  test::PhaseLoopOfTest loop = test::smoothing_loop();
  const auto bounds = loop.bounds();
  CAPTURE(loop.said());
  REQUIRE(bounds);
  for (const double noise : {1e-3, 0.05, 0.5}) {
    double written = 0.0;
    for (const double place : {-1.0, 0.0, 1.0}) {
      written = std::max(written, largest_written_out(noise, kMeanFrequency + place * kHalfBand));
    }
    const double bound = for_ever(*bounds, noise);
    CHECK(bound > written - 1e-6);  // the phases of the sum are points
    CHECK(bound < written + 0.04 * noise + 2e-3);
  }
}

TEST_CASE("Starts decay by the known factor, and what is left is the steady state") {
  test::PhaseLoopOfTest loop = test::smoothing_loop();
  const auto bounds = loop.bounds();
  CAPTURE(loop.said());
  REQUIRE(bounds);
  const double settled = for_ever(*bounds, 0.0);
  const auto errors = bounds->errors(zero, zero, {Ball(0.1)});
  REQUIRE(errors);
  CHECK(errors->for_ever().upper_double() == doctest::Approx(settled + 0.1).epsilon(1e-4));
  const double later = errors->from(Ball(20.0)).upper_double();
  CHECK(later > settled + 0.1 * std::pow(0.9, 20));
  CHECK(later < settled + 0.1 * std::pow(0.9, 20) + 1e-5);
  CHECK(errors->from(Ball(1e9)).upper_double() < settled + 1e-5);
  CHECK(errors->in_long_run().upper_double() < settled + 1e-5);
  CHECK(bounds->starts_within(Ball(0.25)).size() == 1);
  CHECK(bounds->starts_within(Ball(0.25))[0].lower_double() > 0.25);  // and the bias
}

TEST_CASE("The mean over the phase is that of the filter, and the ripple its amplitude") {
  test::PhaseLoopOfTest loop = test::smoothing_loop();
  const auto bounds = loop.bounds();
  CAPTURE(loop.said());
  REQUIRE(bounds);
  const auto errors = bounds->errors(zero, zero, kAtSteadyState);
  REQUIRE(errors);
  const Range mean = errors->mean();  // 0.5 - omega
  CHECK(mean.low.lower_double() < 0.2 - kHalfBand);
  CHECK(mean.low.lower_double() > 0.2 - kHalfBand - 1e-5);
  CHECK(mean.high.upper_double() > 0.2 + kHalfBand);
  CHECK(mean.high.upper_double() < 0.2 + kHalfBand + 1e-5);
  const double amplitude = 0.05 / std::abs(1.0 - 0.9 * std::polar(1.0, -2.0 * kMeanFrequency));
  CHECK(errors->variation().upper_double() > 2.0 * amplitude);
  CHECK(errors->variation().upper_double() < 2.0 * amplitude * 1.02 + 2e-3);
}

TEST_CASE("A frequency that moves leaves errors of a simulation below the bounds") {
  test::PhaseLoopOfTest loop = test::smoothing_loop();
  loop.slew = 1e-5;
  const auto bounds = loop.bounds();
  CAPTURE(loop.said());
  REQUIRE(bounds);
  const double noise = 0.02;
  const double bound = for_ever(*bounds, noise, loop.slew);
  const double without_slew = for_ever(*bounds, noise);
  CHECK(bound > without_slew);
  CHECK(bound < without_slew + 0.01);
  std::mt19937 random(5);
  double omega = kMeanFrequency;
  double phase = 0.0;
  double w = 0.5 + 0.05 * (1.0 / (1.0 - 0.9 * std::polar(1.0, -2.0 * omega))).real();
  double largest = 0.0;
  double direction = 1.0;
  for (int k = 0; k < 200000; ++k) {
    largest = std::max(largest, std::abs(w - omega));
    phase += omega;
    const double cosine = std::cos(phase);
    const double sign = k / 2000 % 2 == 0 || random() % 2 == 0 ? 1.0 : -1.0;
    const double y = cosine + noise * sign * (cosine < 0.0 ? -1.0 : 1.0);
    w = 0.9 * w + 0.1 * y * y;
    direction = omega > kMeanFrequency + 0.99 * kHalfBand   ? -1.0
                : omega < kMeanFrequency - 0.99 * kHalfBand ? 1.0
                                                            : direction;
    omega += direction * 0.99 * loop.slew;
  }
  CHECK(largest < bound);
  CHECK(largest > 0.95 * bound);
}

TEST_CASE("A loop of second order in noise that pushes, simulated, stays below its bounds") {
  test::PhaseLoopOfTest loop = test::narrow_motor_loop();
  const auto bounds = loop.bounds();
  CAPTURE(loop.said());
  REQUIRE(bounds);
  const double noise = 0.02;
  const auto errors = bounds->errors(Ball(noise), zero, {Ball(0.02), Ball(10.0)});
  REQUIRE(errors);
  const double late = errors->in_long_run().upper_double();
  const double omega = 2.0 * 3.14159265358979323846 * 501.0 / 12500.0;
  double largest = 0.0;
  double largest_late = 0.0;
  for (const int period : {1000000, 40, 80, 160, 320}) {
    double angle = omega + 0.02;
    double speed = omega * 12500.0 + 10.0;
    double phase = 0.0;
    for (int k = 0; k < 40000; ++k) {
      const double error = std::abs(speed / 12500.0 - omega);
      largest = std::max(largest, error);
      largest_late = std::max(largest_late, k > 20000 ? error : 0.0);
      phase += omega;
      const double push = k / period % 2 == 0 ? noise : -noise;  // at a right angle
      const double i = std::cos(phase) - push * std::sin(phase);
      const double q = std::sin(phase) + push * std::cos(phase);
      const double d =
          std::atan2(q * std::cos(angle) - i * std::sin(angle), i * std::cos(angle) + q * std::sin(angle));
      angle = angle + (speed + 2000.0 * d) / 12500.0;
      speed = speed + 30000.0 * d / 12500.0;
    }
  }
  CHECK(largest <= errors->for_ever().upper_double());
  CHECK(largest > 0.3 * errors->for_ever().upper_double());
  CHECK(largest_late <= late);
  CHECK(late < errors->for_ever().upper_double());
  CHECK(errors->from(Ball(8000.0)).upper_double() < 1.02 * late);
}

TEST_CASE("Nothing is bounded for what is not a number, nor beyond a slew that the evidence covers") {
  test::PhaseLoopOfTest loop = test::smoothing_loop();
  const auto bounds = loop.bounds();
  CAPTURE(loop.said());
  REQUIRE(bounds);
  for (const Ball& bad : {Ball::everything(), Ball(-1e-3), Ball(HUGE_VAL), Ball(std::nan(""))}) {
    CHECK_FALSE(bounds->errors(bad, zero, kAtSteadyState));
    CHECK_FALSE(bounds->errors(zero, bad, kAtSteadyState));
    CHECK_FALSE(bounds->errors(zero, zero, {bad}));
  }
  CHECK_FALSE(bounds->errors(zero, zero, {}));
  CHECK_FALSE(bounds->errors(zero, zero, {zero, zero}));
  CHECK_FALSE(bounds->errors(zero, one, kAtSteadyState));
  test::PhaseLoopOfTest motor = test::narrow_motor_loop();
  const auto of_motor = motor.bounds();
  REQUIRE(of_motor);
  CHECK_FALSE(of_motor->errors(Ball(0.5), zero, {zero, zero}));
  CHECK_FALSE(of_motor->errors(zero, zero, {Ball(3.0), zero}));
}

}  // namespace veritrack::checker
