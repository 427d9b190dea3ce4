#include "papers/limits/tone_bounds.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "papers/limits/tracking_model.hpp"
#include "tests/support/oracles.hpp"

namespace veritrack::limits {
namespace {

/// The bound on the frequency from a signal given as a function of (parameters, n), its derivatives taken
/// numerically: another parametrisation than the formulas', (a cos + b sin, frequency). The last parameter is
/// the frequency.
double numerical_bound(const std::function<std::complex<double>(const Eigen::Vector3d&, int)>& signal,
                       const Eigen::Vector3d& parameters, double noise_variance, int samples) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (int n = 1; n <= samples; ++n) {
    Eigen::Vector3cd gradient;
    for (int i = 0; i < 3; ++i) {
      const double h = 1e-6;
      gradient(i) = (signal(parameters + h * Eigen::Vector3d::Unit(i), n) -
                     signal(parameters - h * Eigen::Vector3d::Unit(i), n)) /
                    (2.0 * h);
    }
    information += (gradient * gradient.adjoint()).real() / noise_variance;
  }
  return information.inverse()(2, 2);
}

std::complex<double> complex_tone(const Eigen::Vector3d& p, int n) {
  return std::complex<double>(p(0), p(1)) * std::polar(1.0, p(2) * n);
}

std::complex<double> real_tone(const Eigen::Vector3d& p, int n) {
  return p(0) * std::cos(p(2) * n) + p(1) * std::sin(p(2) * n);
}

TEST_CASE("the bounds for a constant frequency are the inverse of the Fisher information") {
  const double variance = 0.02;
  for (const int samples : {3, 10, 57}) {
    for (const double frequency : {0.3, 1.5, 2.9}) {
      CAPTURE(samples);
      CAPTURE(frequency);
      const double amplitude = 1.3;
      const double phase = 0.4;
      const double c = amplitude * std::cos(phase);
      const double s = amplitude * std::sin(phase);
      const double noise_to_signal = variance / (amplitude * amplitude);
      CHECK(
          complex_tone_bound(noise_to_signal, samples) ==
          doctest::Approx(numerical_bound(complex_tone, {c, s, frequency}, variance, samples)).epsilon(1e-6));
      CHECK(real_tone_bound(noise_to_signal, frequency, phase, samples) ==
            doctest::Approx(numerical_bound(real_tone, {c, -s, frequency}, variance, samples)).epsilon(1e-5));
    }
  }
}

TEST_CASE("a real sample is worth half a complex one, when there are many and the frequency is not special") {
  CHECK(real_tone_bound_of_many_samples(0.01, 100) == 2.0 * complex_tone_bound(0.01, 100));
  CHECK(real_tone_bound(0.01, 1.5, 0.3, 1000) ==
        doctest::Approx(real_tone_bound_of_many_samples(0.01, 1000)).epsilon(5e-3));
  CHECK(real_tone_bound(0.01, 0.001, 0.0, 1000) > 2.0 * real_tone_bound_of_many_samples(0.01, 1000));
}

TEST_CASE("the error of a mistuned tracker is that of its steady-state filter on noise alone") {
  // The filter with gains alpha and beta on the phase, its impulse response from noise to frequency summed.
  const double noise_to_signal = 0.005;
  const double q2 = 1e-11;
  const std::complex<double> half_sum(1.0, 0.5 * std::sqrt(q2 / noise_to_signal));
  const std::complex<double> root = half_sum - std::sqrt(half_sum * half_sum - 1.0);
  const double alpha = 1.0 - std::norm(root);
  const double beta = std::norm(1.0 - root);
  double phase = alpha;
  double frequency = beta;
  double sum = 0.0;
  for (int k = 0; k < 20000; ++k) {
    sum += frequency * frequency;
    const double predicted = phase + frequency;
    phase = (1.0 - alpha) * predicted;
    frequency -= beta * predicted;
  }
  CHECK(mistuned_variance(noise_to_signal, q2) == doctest::Approx(noise_to_signal * sum).epsilon(0.01));
  const double samples = samples_until_mistuned(noise_to_signal, q2);
  CHECK(samples == doctest::Approx(3.24 * std::sqrt(std::sqrt(noise_to_signal / q2))).epsilon(0.01));
  CHECK(complex_tone_bound(noise_to_signal, static_cast<int>(samples)) ==
        doctest::Approx(mistuned_variance(noise_to_signal, q2)).epsilon(0.02));
}

TEST_CASE("signal-to-noise ratios") {
  CHECK(noise_variance_of(0.0) == 0.5);
  CHECK(noise_variance_of(10.0) == doctest::Approx(0.05));
}

}  // namespace
}  // namespace veritrack::limits
