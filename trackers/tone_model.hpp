// Shared by the extended Kalman filters of one tone: the model for which they are designed, and the estimate.
//
// State (x1, x2, x3): in-phase and quadrature part in signal units, frequency in rad/sample. With z = x1 + i
// x2,
//     z(k+1) = e^{i x3(k)} z(k) + noise,   x3(k+1) = (1 - epsilon) x3(k) + noise.
#pragma once

#include <Eigen/Core>

#include "trackers/factored_covariance.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::trackers {

/// The engineer's choices: the noise that the filter assumes, Q = diag(q1, q1, q2) and r, and the leak. They
/// do not say which channels are measured.
template <typename Scalar>
struct ToneModel {
  Scalar q1;       ///< process noise variance of in-phase and quadrature part, signal units squared; >= 0
  Scalar q2;       ///< process noise variance of the frequency, (rad/sample)^2; > 0
  Scalar r;        ///< measurement noise variance of each channel, signal units squared; > 0
  Scalar epsilon;  ///< leak of the frequency towards zero per sample; in [0, 1)

  /// True only when epsilon is certainly zero.
  [[nodiscard]] bool without_leak() const { return epsilon == Scalar(0.0); }
};

/// The model whose filter at amplitude 1 does what that of `model` does at `amplitude` (signal units, > 0),
/// with the noise bound divided by the amplitude too: z scales by A, so q1 and r scale by A^2 and q2 stays.
template <typename Scalar>
[[nodiscard]] ToneModel<Scalar> at_unit_amplitude(const ToneModel<Scalar>& model, const Scalar& amplitude) {
  using detail::square;
  const Scalar power = square(amplitude);
  return {model.q1 / power, model.q2, model.r / power, model.epsilon};
}

/// A state estimate with its covariance: filtered, (k|k), or predicted, (k+1|k).
template <typename Scalar>
struct ToneEstimate {
  Scalar in_phase;    ///< x1, signal units
  Scalar quadrature;  ///< x2, signal units
  Scalar frequency;   ///< x3, rad/sample
  FactoredCovariance<Scalar> covariance;

  /// (x1, x2, x3).
  [[nodiscard]] Eigen::Matrix<Scalar, 3, 1> state() const {
    Eigen::Matrix<Scalar, 3, 1> result;
    result(0) = in_phase;
    result(1) = quadrature;
    result(2) = frequency;
    return result;
  }
};

/// The estimate turned about the origin of the plane by an angle given as its sine and cosine: z becomes e^{i
/// angle} z, and P becomes U P U' with U = diag(Rot(angle), 1).
template <typename Scalar>
[[nodiscard]] inline ToneEstimate<Scalar> turned(const ToneEstimate<Scalar>& estimate, const Scalar& sine,
                                                 const Scalar& cosine) {
  return {estimate.in_phase * cosine - estimate.quadrature * sine,
          estimate.in_phase * sine + estimate.quadrature * cosine, estimate.frequency,
          turned(estimate.covariance, sine, cosine)};
}

}  // namespace veritrack::trackers
