#include "analysis/model/steady_state/steady_state.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/model/tube/tube_proposal.hpp"
#include "tests/analysis/model/example_recursions.hpp"

namespace veritrack::model {
namespace {

using test::ExampleTracker;
using test::tone_of;
using trackers::Operation;
using trackers::StraightLineProgram;

/// A tracker of one state x' = f(x, y), whose frequency is its first constant.
template <typename Build>
ExampleTracker one_state(const Build& build, const std::vector<double>& constants, double start) {
  ExampleTracker example;
  example.recursion.constants = static_cast<int>(constants.size());
  example.recursion.states = 1;
  example.recursion.samples = 1;
  example.recursion.is_angle = {false};
  StraightLineProgram step(example.recursion.constants + 2);
  step.add_result(build(step, example.recursion.constants, example.recursion.constants + 1));
  example.recursion.step = step;
  example.recursion.frequency = StraightLineProgram(example.recursion.constants + 1);
  example.recursion.frequency.add_result(0);
  example.constants = constants;
  example.start = [start](double) { return std::vector<double>{start}; };
  return example;
}

/// x' = c x + y, with the frequency c.
ExampleTracker low_pass(double c) {
  return one_state(
      [](StraightLineProgram& step, int x, int y) {
        return step.append(Operation::add, step.append(Operation::multiply, 0, x), y);
      },
      {c}, 0.0);
}

TEST_CASE("a linear filter settles on its transfer function") {
  const ExampleTracker example = low_pass(0.9);
  const SteadyState steady = find_steady_state(tone_of(example), 0.4);
  REQUIRE(steady.outcome == SteadyStateOutcome::settled);
  CHECK(steady.frequency == doctest::Approx(0.4).epsilon(1e-3));
  CHECK(steady.rate == doctest::Approx(0.9).epsilon(1e-9));
  CHECK(steady.mean_error == doctest::Approx(0.9 - steady.frequency));
  // x = Re g exp(i phi), g = 1/(1 - c exp(-i omega)): x(phi) = c x(phi - omega) + cos(phi).
  const std::complex<double> gain = 1.0 / (1.0 - 0.9 * std::polar(1.0, -steady.frequency));
  for (int j = 0; j < steady.period; j += 17) {
    const double phase = 2.0 * std::numbers::pi * j / steady.period;
    CHECK(steady.states(0, j) ==
          doctest::Approx((gain * std::polar(1.0, phase)).real()).epsilon(1e-6).scale(1.0));
  }
}

/// A loop of two channels with a second integrator, which rests at 0: states theta, w, rate.
ExampleTracker third_order_loop() {
  ExampleTracker example;
  example.recursion.constants = 3;
  example.recursion.states = 3;
  example.recursion.samples = 2;
  example.recursion.is_angle = {true, false, false};
  StraightLineProgram step(8);
  const int theta = 3, w = 4, rate = 5, y1 = 6, y2 = 7;
  const auto product = [&](int a, int b) { return step.append(Operation::multiply, a, b); };
  const auto sum = [&](int a, int b) { return step.append(Operation::add, a, b); };
  const int error = step.append(Operation::subtract, product(y2, step.append(Operation::cos, theta)),
                                product(y1, step.append(Operation::sin, theta)));
  const int next_rate = sum(rate, product(2, error));
  const int next_w = sum(sum(w, next_rate), product(1, error));
  step.add_result(sum(sum(theta, next_w), product(0, error)));
  step.add_result(next_w);
  step.add_result(next_rate);
  example.recursion.step = step;
  example.recursion.frequency = test::frequency_of_state(3, 3, 1);
  example.constants = {0.2, 0.01, 0.0002};
  example.start = [](double omega) { return std::vector<double>{omega, omega, 0.0}; };
  return example;
}

TEST_CASE("a state that rests at 0, apart from rounding, is at rest") {
  const SteadyState steady = find_steady_state(tone_of(third_order_loop(), true), 0.3);
  CHECK(steady.outcome == SteadyStateOutcome::settled);
  CHECK(std::fabs(steady.mean_error) < 1e-9);
}

TEST_CASE("what does not settle is named, with its numbers") {
  SUBCASE("diverges") {
    const SteadyState steady = find_steady_state(tone_of(low_pass(1.1)), 0.4);
    CHECK(steady.outcome == SteadyStateOutcome::diverges);
    CHECK(reason_of(steady).find("diverges") != std::string::npos);
  }
  SUBCASE("an integrator is not exponentially stable") {
    const SteadyState steady = find_steady_state(tone_of(low_pass(1.0)), 0.4);
    CHECK(steady.outcome == SteadyStateOutcome::not_exponentially_stable);
    CHECK(steady.rate == doctest::Approx(1.0).epsilon(1e-9));
    REQUIRE(steady.mode.size() == 1);
    CHECK(steady.mode[0] == 1.0);
  }
  SUBCASE("too slow for the simulation") {
    const SteadyState steady = find_steady_state(tone_of(low_pass(0.9995)), 0.4, {10000, INFINITY});
    CHECK(steady.outcome == SteadyStateOutcome::still_drifts);
    CHECK(steady.slowest_state == 0);
    CHECK(steady.samples <= 10000);
    CHECK(std::fabs(steady.drift[0]) > 0.0);
    CHECK(reason_of(steady).find("still moves by") != std::string::npos);
  }
  SUBCASE("a mean frequency that is far off") {
    const SteadyState steady = find_steady_state(tone_of(low_pass(0.9)), 0.4, {100000, 0.1});
    CHECK(steady.outcome == SteadyStateOutcome::locked_elsewhere);
    CHECK(steady.mean_error == doctest::Approx(0.9 - steady.frequency));
  }
  SUBCASE("a flip-flop returns after two samples") {
    // x' = -c x + x^3: the fixed point 0 is unstable, x = +-sqrt(c - 1) flips.
    const ExampleTracker flip = one_state(
        [](StraightLineProgram& step, int x, int /*y*/) {
          const int linear = step.append(Operation::multiply, 0, x);
          return step.append(Operation::subtract, step.append({Operation::power, x, -1, -1, 3}), linear);
        },
        {1.3}, 0.2);
    const SteadyState steady = find_steady_state(tone_of(flip), 0.4);
    CHECK(steady.outcome == SteadyStateOutcome::repeats_later);
    CHECK(steady.repetition == 2);
  }
}

TEST_CASE("a phase-locked loop locks: its angle turns once, from any start nearby") {
  ExampleTracker example = test::phase_locked_loop();
  const SteadyState steady = find_steady_state(tone_of(example), 0.3);
  REQUIRE(steady.outcome == SteadyStateOutcome::settled);
  CHECK(steady.turns == std::vector<int>{0, 1});
  CHECK(std::fabs(steady.mean_error) < 1e-9);
  CHECK(steady.rate == doctest::Approx(std::sqrt(1.0 - 0.02828)).epsilon(1e-3));
  example.start = [](double omega) { return std::vector<double>{omega + 0.004, 0.1}; };
  const SteadyState other = find_steady_state(tone_of(example), 0.3);
  REQUIRE(other.outcome == SteadyStateOutcome::settled);
  CHECK((other.states - steady.states).cwiseAbs().maxCoeff() < 1e-8);
}

TEST_CASE("a slow loop begins at the frequency of the tone that is simulated") {
  // Begun at the one that is asked for, it would be far outside its bandwidth and drift for ever.
  constexpr double kBandwidth = 3e-5;
  constexpr double kAsked = 0.31416;
  ExampleTracker example = test::phase_locked_loop(kBandwidth);
  example.start = [](double omega) { return std::vector<double>{omega, omega}; };
  const SteadyState steady = find_steady_state(tone_of(example), kAsked);
  REQUIRE(std::fabs(steady.frequency - kAsked) > 5.0 * kBandwidth);
  REQUIRE_MESSAGE(steady.outcome == SteadyStateOutcome::settled, reason_of(steady));
  CHECK(steady.rate == doctest::Approx(1.0 - 0.7071 * kBandwidth).epsilon(1e-6));
}

TEST_CASE("a slow loop that begins elsewhere is told how long it takes") {
  ExampleTracker example = test::phase_locked_loop(1e-4);
  example.start = [](double omega) { return std::vector<double>{omega + 2e-5, omega}; };
  const SteadyState steady = find_steady_state(tone_of(example), 0.25, {80000, INFINITY});
  CHECK(steady.outcome == SteadyStateOutcome::still_drifts);
  CHECK(reason_of(steady).find("settling may take") != std::string::npos);
}

TEST_CASE("an angle that is not called one is told from a drift") {
  ExampleTracker example = test::phase_locked_loop();
  example.recursion.is_angle = {false, false};
  const SteadyState steady = find_steady_state(tone_of(example), 0.25, {20000, INFINITY});
  CHECK(steady.outcome == SteadyStateOutcome::still_drifts);
  CHECK(
      reason_of(steady).find("turns once while the phase turns once; if it is an angle, name it in angles") !=
      std::string::npos);
}

TEST_CASE("a lock on a harmonic is called so") {
  ExampleTracker example = test::phase_locked_loop();
  example.start = [](double omega) { return std::vector<double>{3.0 * omega, 0.0}; };
  TrackedTone tone = tone_of(example);
  tone.signal = {{{0.0, 1.0, 0.0, 0.5}}};
  const SteadyState steady = find_steady_state(tone, 0.25, {100000, 0.1});
  CHECK(steady.outcome == SteadyStateOutcome::locked_elsewhere);
  CHECK(reason_of(steady).find("it has locked to harmonic number 3") != std::string::npos);
  // 2.6 times the frequency is none of them.
  const SteadyState other = find_steady_state(tone_of(low_pass(0.9)), 0.9 / 2.6, {100000, 0.1});
  CHECK(reason_of(other).find("something else") != std::string::npos);
}

TEST_CASE("a covariance that decays like 1/N is not taken for one that has settled") {
  // It began at 1: what it still moves in a period is soon little beside that, but not beside what is left.
  ExampleTracker example = test::kalman_filter(1, 0.0, 0.01);
  example.start = [](double omega) {
    return std::vector<double>{1.0, 0.0, omega, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0};
  };
  const SteadyState steady = find_steady_state(tone_of(example), 0.5);
  CHECK(steady.outcome == SteadyStateOutcome::not_exponentially_stable);
  CHECK(steady.rate < 1.0);
  CHECK(reason_of(steady).find("it is not exponentially") != std::string::npos);
}

TEST_CASE("a Kalman filter without process noise is not exponentially stable") {
  ExampleTracker example = test::kalman_filter(2, 0.0023, 0.05);
  example.constants[0] = 0.0;
  const SteadyState steady = find_steady_state(tone_of(example), 0.5, {20000, INFINITY});
  CHECK(steady.outcome == SteadyStateOutcome::not_exponentially_stable);
}

TEST_CASE("frequencies and states that are none are refused") {
  const ExampleTracker example = low_pass(0.9);
  CHECK_THROWS_AS((void)find_steady_state(tone_of(example), 0.0), std::invalid_argument);
  CHECK_THROWS_AS((void)find_steady_state(tone_of(example), 3.2), std::invalid_argument);
  CHECK_THROWS_AS((void)find_steady_state(tone_of(example), NAN), std::invalid_argument);
  ExampleTracker wrong = low_pass(0.9);
  wrong.start = [](double) { return std::vector<double>{0.0, 0.0}; };
  CHECK_THROWS_AS((void)find_steady_state(tone_of(wrong), 0.4), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::model
