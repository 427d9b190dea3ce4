#include "analysis/model/steady_state/linear_worst_case.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tests/analysis/model/example_recursions.hpp"

namespace veritrack::model {
namespace {

using test::ExampleTracker;
using test::tone_of;
using trackers::Operation;
using trackers::StraightLineProgram;

/// x' = c x + y; x is the estimate.
ExampleTracker leaky_sum(double c) {
  ExampleTracker example;
  example.recursion.constants = 1;
  example.recursion.states = 1;
  example.recursion.samples = 1;
  example.recursion.is_angle = {false};
  StraightLineProgram step(3);
  step.add_result(step.append(Operation::add, step.append(Operation::multiply, 0, 1), 2));
  example.recursion.step = step;
  example.recursion.frequency = test::frequency_of_state(1, 1, 0);
  example.constants = {c};
  example.start = [](double) { return std::vector<double>{0.0}; };
  return example;
}

TEST_CASE("of a linear filter of the first order: noise counts 1/(1 - c)") {
  const double c = 0.9;
  const double omega = 0.4;
  const TrackedTone tone = tone_of(leaky_sum(c));
  const LinearWorstCase quiet = linear_worst_case(tone, omega, 0.0, 0.0).value();
  CHECK(quiet.frequency == omega);
  CHECK(quiet.disturbed == quiet.undisturbed);
  // x = Re g exp(i phi), g = 1/(1 - c exp(-i omega)).
  const std::complex<double> gain = 1.0 / (1.0 - c * std::polar(1.0, -omega));
  CHECK(quiet.undisturbed == doctest::Approx(std::abs(gain) + omega).epsilon(0.01));
  CHECK(quiet.undisturbed <= std::abs(gain) + omega + 1e-9);
  const LinearWorstCase noisy = linear_worst_case(tone, omega, 0.03, 0.0).value();
  CHECK(noisy.disturbed - noisy.undisturbed == doctest::Approx(0.03 / (1.0 - c)).epsilon(1e-4));
}

TEST_CASE("a slew counts by how far the curve moves") {
  const double c = 0.6;
  const double omega = 0.4;
  const double slew = 0.01;
  const TrackedTone tone = tone_of(leaky_sum(c));
  const double found = linear_worst_case(tone, omega, 0.0, slew, 300).value().disturbed;
  // dC/domega = Re g' exp(i phi), g' = -i c exp(-i omega) g^2.
  const std::complex<double> turn = std::polar(1.0, -omega);
  const std::complex<double> gain = 1.0 / (1.0 - c * turn);
  const std::complex<double> slope = std::complex<double>(0.0, -c) * turn * gain * gain;
  double largest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double phase = 2.0 * std::numbers::pi * i / 2000;
    double sum = std::fabs((gain * std::polar(1.0, phase)).real() - omega);
    for (int j = 0; j < 100; ++j) {
      sum += slew * std::pow(c, j) * std::fabs((slope * std::polar(1.0, phase - j * omega)).real());
    }
    largest = std::max(largest, sum);
  }
  CHECK(found == doctest::Approx(largest).epsilon(2e-3));
}

TEST_CASE(
    "noise that is chosen against a loop of the second order reaches it, and no more while it is small") {
  const ExampleTracker loop = test::phase_locked_loop();
  const TrackedTone tone = tone_of(loop);
  const double omega = 0.3;
  const double noise = 1e-6;
  const LinearWorstCase worst = linear_worst_case(tone, omega, noise, 0.0).value();
  // Signs of the noise, sample by sample, from how single pulses move the estimate at the end.
  constexpr int kSamples = 1500;
  const auto estimate = [&](const std::vector<double>& disturbances) {
    Eigen::VectorXd state(2);
    state << omega, 0.0;
    for (int k = -8000; k < kSamples; ++k) {
      Eigen::VectorXd sample = samples_of(tone.signal, 1.0, omega * (k + 1));
      sample[0] += k >= 0 ? disturbances[static_cast<std::size_t>(k)] : 0.0;
      state = tone.step.next(state, sample);
    }
    return state[0];
  };
  std::vector<double> disturbances(kSamples, 0.0);
  const double before = estimate(disturbances);
  std::vector<double> signs(kSamples, 0.0);
  for (int k = kSamples - 400; k < kSamples; ++k) {
    std::vector<double> pulse(kSamples, 0.0);
    pulse[static_cast<std::size_t>(k)] = 1e-4;
    signs[static_cast<std::size_t>(k)] = estimate(pulse) > before ? noise : -noise;
  }
  const double reached = estimate(signs) - before;
  // This is one phase; the estimate is about the worst.
  CHECK(reached < 1.001 * (worst.disturbed - worst.undisturbed));
  CHECK(reached > 0.8 * (worst.disturbed - worst.undisturbed));
}

TEST_CASE("nothing without a steady state, and no nonsense") {
  CHECK_FALSE(linear_worst_case(tone_of(leaky_sum(1.1)), 0.4, 0.01, 0.0));
  const TrackedTone tone = tone_of(leaky_sum(0.9));
  CHECK_THROWS_AS((void)linear_worst_case(tone, 0.4, -0.01, 0.0), std::invalid_argument);
  CHECK_THROWS_AS((void)linear_worst_case(tone, 0.4, NAN, 0.0), std::invalid_argument);
  CHECK_THROWS_AS((void)linear_worst_case(tone, 0.4, 0.01, 0.0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::model
