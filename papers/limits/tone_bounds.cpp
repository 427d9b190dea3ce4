#include "papers/limits/tone_bounds.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::limits {

double complex_tone_bound(double noise_to_signal, int samples) {
  const rigor::NearestRounding nearest;
  const double n = samples;
  return 12.0 * noise_to_signal / (n * (n * n - 1.0));
}

double real_tone_bound_of_many_samples(double noise_to_signal, int samples) {
  return complex_tone_bound(2.0 * noise_to_signal, samples);
}

double real_tone_bound(double noise_to_signal, double frequency, double phase, int samples) {
  const rigor::NearestRounding nearest;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (int n = 1; n <= samples; ++n) {
    const double angle = phase + frequency * n;
    const Eigen::Vector3d gradient(std::cos(angle), -std::sin(angle), -n * std::sin(angle));
    information += gradient * gradient.transpose() / noise_to_signal;
  }
  return information.inverse()(2, 2);
}

double mistuned_variance(double noise_to_signal, double tracker_q2) {
  const rigor::NearestRounding nearest;
  return std::sqrt(std::sqrt(noise_to_signal)) * std::pow(tracker_q2, 0.75) / (2.0 * std::numbers::sqrt2);
}

double samples_until_mistuned(double noise_to_signal, double tracker_q2) {
  const rigor::NearestRounding nearest;
  return std::cbrt(12.0 * noise_to_signal / mistuned_variance(noise_to_signal, tracker_q2));
}

}  // namespace veritrack::limits
