// The filter linearised about lock, for comparison: floating point, nothing here is evidence.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "analysis/quadrature/gaussian/level_covariance.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// The linearised filter's step of the errors x = (e2, nu) of phase (rad) and frequency (rad/sample) of a
/// signal of amplitude 1 in its steady state: x+ = A x + K v - w e2, without a leak.
struct LinearFilter {
  Eigen::Matrix2d errors;  ///< A
  Eigen::Vector2d gain;    ///< K
  /// N = A'NA + diag(0, 1): x'Nx is the sum of all later squares of the frequency error.
  Eigen::Matrix2d later;
};

/// About this filtered covariance; nothing when the errors do not settle.
[[nodiscard]] std::optional<LinearFilter> linear_filter(const trackers::ToneModel<double>& design,
                                                        const LevelCovariance<double>& covariance);

/// Its steady variance of the frequency error, (rad/sample)^2, for noise of this deviation in each channel
/// and a frequency that walks with this deviation, rad/sample.
[[nodiscard]] double frequency_variance(const LinearFilter& filter, double noise_deviation, double walk);

/// The posterior Cramer-Rao bound on that variance, of any tracker: the information of a measurement does not
/// depend on the phase, so that it is the variance of the Kalman filter for these two deviations. 0 for a
/// constant frequency. P. Tichavsky and others, IEEE Trans. Signal Processing 46 (1998), 1386.
[[nodiscard]] double least_frequency_variance(double noise_deviation, double walk);

}  // namespace veritrack::quadrature
