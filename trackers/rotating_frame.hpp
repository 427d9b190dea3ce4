// The state of a tracker of one tone in the frame that turns with the true signal: nine numbers
//     X = (Re delta, Im delta, nu, P11, P12, P13, P22, P23, P33),
//     delta = e^{-i phi(k)} z(k|k) - 1,  nu = x3(k|k) - omega(k),  P = U(-phi(k)) P(k|k) U(-phi(k))',
// U(angle) = diag(Rot(angle), 1), for the true signal z = e^{i phi(k)}: always the *filtered* estimate and
// covariance, in the frame of the *true* phase at the same time k.
#pragma once

#include <Eigen/Core>

#include "trackers/scalar_functions.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::trackers {

/// X, see the top of this file. delta is relative to the amplitude 1, nu in rad/sample.
template <typename Scalar>
using RotatingFrameState = Eigen::Matrix<Scalar, 9, 1>;

/// The positions of the entries of X.
enum RotatingFrameIndex : Eigen::Index {
  kDeltaInPhase = 0,
  kDeltaQuadrature = 1,
  kFrequencyError = 2,
  kP11 = 3,
  kP12 = 4,
  kP13 = 5,
  kP22 = 6,
  kP23 = 7,
  kP33 = 8
};

/// X of a filtered estimate, when the true signal is amplitude * e^{i phase} with this frequency
/// (rad/sample). P is scaled to amplitude 1 as well.
template <typename Scalar>
[[nodiscard]] RotatingFrameState<Scalar> to_rotating_frame(const ToneEstimate<Scalar>& filtered,
                                                           const Scalar& amplitude, const Scalar& phase,
                                                           const Scalar& frequency) {
  using detail::sin_cos;
  const auto [sine_raw, cosine_raw] = sin_cos(phase);
  const Scalar sine = sine_raw / amplitude;
  const Scalar cosine = cosine_raw / amplitude;
  const Eigen::Matrix<Scalar, 3, 3> p = filtered.covariance.matrix();
  // Row by row of the turn Rot(-phase) / amplitude applied from both sides.
  const Scalar a11 = cosine * p(0, 0) + sine * p(0, 1);
  const Scalar a12 = cosine * p(0, 1) + sine * p(1, 1);
  const Scalar a21 = cosine * p(0, 1) - sine * p(0, 0);
  const Scalar a22 = cosine * p(1, 1) - sine * p(0, 1);
  RotatingFrameState<Scalar> state;
  state(kDeltaInPhase) = cosine * filtered.in_phase + sine * filtered.quadrature - Scalar(1.0);
  state(kDeltaQuadrature) = cosine * filtered.quadrature - sine * filtered.in_phase;
  state(kFrequencyError) = filtered.frequency - frequency;
  state(kP11) = a11 * cosine + a12 * sine;
  state(kP12) = a12 * cosine - a11 * sine;
  state(kP22) = a22 * cosine - a21 * sine;
  state(kP13) = cosine * p(0, 2) + sine * p(1, 2);
  state(kP23) = cosine * p(1, 2) - sine * p(0, 2);
  state(kP33) = p(2, 2);
  return state;
}

}  // namespace veritrack::trackers
