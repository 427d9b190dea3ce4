// The filter with a leak, linearised about the errors at which it settles: floating point, nothing here is
// evidence.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "analysis/quadrature/gaussian/lock_centre.hpp"

namespace veritrack::quadrature {

/// The effect of the step on small changes of the steady state at a constant frequency, errors and covariance
/// together: x+ = J x + B v, x = (Re delta, Im delta, nu, P11, P12, P13, P22, P23, P33).
struct LeakingFilter {
  LockCentre steady;
  Eigen::Matrix<double, 9, 9> step;   ///< J
  Eigen::Matrix<double, 9, 2> noise;  ///< B
  /// With A the part of J from errors to errors, N = A'NA + diag(0, 0, 1): e'Ne is the sum of all later
  /// squares of a change e, the covariance held; and (I - A')^-1 e3, the sum of all later changes of nu.
  Eigen::Matrix3d later;
  Eigen::Vector3d later_sum;
};

/// For a signal of amplitude 1 and this frequency, rad/sample; nothing when there is no steady state or small
/// changes do not settle.
[[nodiscard]] std::optional<LeakingFilter> leaking_filter(const trackers::ToneModel<double>& design,
                                                          double frequency);

/// The mean square of the frequency error in noise of this deviation in each channel, (rad/sample)^2: the
/// square of the bias and the variance. Nothing when errors and covariance together do not settle.
[[nodiscard]] std::optional<double> mean_square_frequency_error(const LeakingFilter& filter,
                                                                double noise_deviation);

}  // namespace veritrack::quadrature
