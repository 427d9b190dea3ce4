#include "papers/limits/posterior_bound.hpp"

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <cstddef>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::limits {

namespace {

double squared(double x) {
  return x * x;
}

/// E[(dh/dx)' R^-1 dh/dx] at time k, when the phase is normal with this mean and variance.
Eigen::Matrix3d measurement_information(const TrackingModel& model, double phase, double phase_variance) {
  const bool random = model.drawn == DrawnAtStart::truth;
  const double mean_square_amplitude =
      squared(kMeanAmplitude) + (random ? squared(model.amplitude_deviation) : 0.0);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  if (model.channels == Channels::quadrature) {
    information(0, 0) = 1.0;
    information(1, 1) = mean_square_amplitude;
  } else {
    // dh/dx = (cos phi, -A sin phi, 0), and E e^{2 i phi} is the characteristic function of the normal law.
    const double coherence = std::exp(-2.0 * phase_variance);
    const double cosine = coherence * std::cos(2.0 * phase);
    const double sine = coherence * std::sin(2.0 * phase);
    information(0, 0) = 0.5 * (1.0 + cosine);
    information(1, 1) = 0.5 * mean_square_amplitude * (1.0 - cosine);
    information(0, 1) = -0.5 * kMeanAmplitude * sine;
    information(1, 0) = information(0, 1);
  }
  return information / model.noise_variance;
}

}  // namespace

std::vector<double> posterior_frequency_bounds(const TrackingModel& model, int samples) {
  const rigor::NearestRounding nearest;
  Eigen::Matrix3d dynamics = Eigen::Matrix3d::Identity();
  dynamics(1, 2) = 1.0;
  // J^-1, beginning at the start.
  Eigen::Matrix3d bound = Eigen::Vector3d(squared(model.amplitude_deviation), squared(model.phase_deviation),
                                          squared(model.frequency_deviation))
                              .asDiagonal();
  const bool random = model.drawn == DrawnAtStart::truth;
  double walked_phase = 0.0;  // variance of the phase due to the walk, over walk_variance
  std::vector<double> bounds;
  bounds.reserve(static_cast<std::size_t>(samples));
  for (int k = 1; k <= samples; ++k) {
    walked_phase += squared(k - 1.0);
    const double start_phase =
        random ? squared(model.phase_deviation) + squared(k * model.frequency_deviation) : 0.0;
    bound = dynamics * bound * dynamics.transpose();
    bound(2, 2) += model.walk_variance;
    bound = (bound.inverse() + measurement_information(model, kMeanPhase + k * kMeanFrequency,
                                                       start_phase + model.walk_variance * walked_phase))
                .inverse();
    bounds.push_back(bound(2, 2));
  }
  return bounds;
}

double steady_frequency_bound(double noise_to_signal, double walk_variance) {
  const rigor::NearestRounding nearest;
  // s p(z) p(1/z) = noise_to_signal (2 - z - 1/z)^2 + walk_variance, p the closed loop's characteristic
  // polynomial and s the innovation variance: z + 1/z = 2 + i sqrt(walk_variance / noise_to_signal) at one of
  // its two conjugate roots.
  const std::complex<double> half_sum(1.0, 0.5 * std::sqrt(walk_variance / noise_to_signal));
  const std::complex<double> difference = std::sqrt(half_sum * half_sum - 1.0);
  const std::complex<double> root =
      std::abs(half_sum - difference) < 1.0 ? half_sum - difference : half_sum + difference;
  const double phase_gain = 1.0 - std::norm(root);
  const double frequency_gain = std::norm(1.0 - root);
  return phase_gain * frequency_gain * noise_to_signal / (1.0 - phase_gain);
}

}  // namespace veritrack::limits
