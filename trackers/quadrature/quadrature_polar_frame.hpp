// The quadrature tracker and its signal as one autonomous map, seen from the phase of the estimate.
//
// Like quadrature_rotating_frame.hpp, but in polar coordinates. Let the true signal be s(k) = e^{i phi(k)},
// phi(k+1) = phi(k) + omega(k), and z(k|k) the filtered estimate. The state of the closed loop is
//     amplitude error  a   = |z| - 1,
//     phase error      psi = arg z - phi                                  (rad),
//     frequency error  nu  = x3 - omega                                   (rad/sample),
//     covariance       P   = U(-arg z) P(k|k) U(-arg z)', U(angle) = diag(Rot(angle), 1):
// always the *filtered* estimate and covariance, in the frame of the *estimated* phase at the same time k:
// the first row of P is the direction of the amplitude, the second that of the phase.
//
// Why this frame. F(rho) = [[1,0,0], [0,1,rho], [0,0,1-epsilon]], rho = |z|, has one parameter, so that P
// evolves by a Riccati equation that the errors enter through rho and through a turn by the angle `turn`
// alone; that equation is monotone in P. For epsilon = 0 the errors a = psi = nu = 0 stay zero whatever P is.
// And the rows of the state bound amplitude, phase and frequency error directly.
//
// This is the filter of quadrature_ekf.hpp in other coordinates and another order of evaluation. Certificates
// are about this map; tests tie it to `step` there, by an identity of values and first derivatives on dual
// numbers over intervals (tests/trackers/frame_identity_test.cpp). It makes sense for any symmetric P with
// det S != 0, S the innovation covariance, and as long as the filtered z is not zero.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::trackers {

/// A symmetric 3x3 matrix by its entries on and above the diagonal: (amplitude, phase, frequency).
template <typename Scalar>
struct PolarCovariance {
  Scalar p11, p12, p13, p22, p23, p33;

  /// Reads the upper triangle.
  [[nodiscard]] static PolarCovariance from_matrix(const Eigen::Matrix<Scalar, 3, 3>& matrix) {
    return {matrix(0, 0), matrix(0, 1), matrix(0, 2), matrix(1, 1), matrix(1, 2), matrix(2, 2)};
  }
  [[nodiscard]] Eigen::Matrix<Scalar, 3, 3> matrix() const {
    Eigen::Matrix<Scalar, 3, 3> result;
    result(0, 0) = p11;
    result(0, 1) = result(1, 0) = p12;
    result(0, 2) = result(2, 0) = p13;
    result(1, 1) = p22;
    result(1, 2) = result(2, 1) = p23;
    result(2, 2) = p33;
    return result;
  }
};

/// The errors (a, psi, nu) of the filtered estimate; amplitude relative to the true one.
template <typename Scalar>
struct PolarError {
  Scalar amplitude;  ///< |z| - 1
  Scalar phase;      ///< arg z - phi, rad
  Scalar frequency;  ///< x3 - omega, rad/sample
};

/// The inputs of the closed loop from k to k+1.
template <typename Scalar>
struct PolarInput {
  /// The measurement noise v(k+1), turned into the frame of the predicted phase: a plane vector with |v''| =
  /// |v|, and any direction when |v| is all that is known. Relative to the true amplitude.
  Scalar noise_along, noise_across;
  Scalar slew;       ///< w = omega(k+1) - omega(k), rad/sample
  Scalar frequency;  ///< omega(k), rad/sample; without effect when epsilon = 0
};

/// F P F' + Q, F = F(rho): the covariance (k+1|k) in the frame of the predicted phase, rho = |z(k|k)|.
template <typename Scalar>
[[nodiscard]] PolarCovariance<Scalar> predicted_covariance(const PolarCovariance<Scalar>& p,
                                                           const Scalar& rho,
                                                           const ToneModel<Scalar>& design) {
  using detail::square;
  const Scalar retention = Scalar(1.0) - design.epsilon;
  return {p.p11 + design.q1,
          p.p12 + rho * p.p13,
          retention * p.p13,
          p.p22 + rho * (p.p23 + p.p23 + rho * p.p33) + design.q1,
          retention * (p.p23 + rho * p.p33),
          square(retention) * p.p33 + design.q2};
}

/// The gain K = P H' S^-1, S = H P H' + r I, of a predicted covariance P. Rows: amplitude, phase, frequency;
/// columns: innovation along and across the predicted phase. Its upper 2x2 block, I - r S^-1, is symmetric.
template <typename Scalar>
struct PolarGain {
  Scalar k11, k12, k22;  ///< amplitude and phase
  Scalar k31, k32;       ///< frequency, rad/sample
};

/// The gain of a predicted covariance. Assumes det S != 0.
template <typename Scalar>
[[nodiscard]] PolarGain<Scalar> gain(const PolarCovariance<Scalar>& predicted, const Scalar& r) {
  using detail::square;
  const Scalar s11 = predicted.p11 + r;
  const Scalar s22 = predicted.p22 + r;
  const Scalar reciprocal = Scalar(1.0) / (s11 * s22 - square(predicted.p12));
  const Scalar i11 = s22 * reciprocal;
  const Scalar i12 = -(predicted.p12 * reciprocal);
  const Scalar i22 = s11 * reciprocal;
  return {Scalar(1.0) - r * i11, -(r * i12), Scalar(1.0) - r * i22, predicted.p13 * i11 + predicted.p23 * i12,
          predicted.p13 * i12 + predicted.p23 * i22};
}

/// P - K S K': the covariance (k+1|k+1), still in the frame of the predicted phase. K H P, the remainder, is
/// r K for the columns of z, since K = (P - K S K') H' / r.
template <typename Scalar>
[[nodiscard]] PolarCovariance<Scalar> filtered_covariance(const PolarCovariance<Scalar>& predicted,
                                                          const PolarGain<Scalar>& k, const Scalar& r) {
  return {r * k.k11, r * k.k12, r * k.k31,
          r * k.k22, r * k.k32, predicted.p33 - (k.k31 * predicted.p13 + k.k32 * predicted.p23)};
}

/// U P U' with U = diag(Rot(angle), 1), the angle given by its sine and cosine.
template <typename Scalar>
[[nodiscard]] PolarCovariance<Scalar> turned(const PolarCovariance<Scalar>& p, const Scalar& sine,
                                             const Scalar& cosine) {
  using detail::square;
  // A symmetric 2x2 matrix is its mean times I, which stays, plus a part that turns twice as fast.
  const Scalar sine_twice = (sine + sine) * cosine;
  const Scalar sine_squared = square(sine);
  const Scalar cosine_twice = Scalar(1.0) - (sine_squared + sine_squared);
  const Scalar mean = Scalar(0.5) * (p.p11 + p.p22);
  const Scalar half_difference = Scalar(0.5) * (p.p11 - p.p22);
  const Scalar turned_difference = half_difference * cosine_twice - p.p12 * sine_twice;
  return {mean + turned_difference,      half_difference * sine_twice + p.p12 * cosine_twice,
          p.p13 * cosine - p.p23 * sine, mean - turned_difference,
          p.p13 * sine + p.p23 * cosine, p.p33};
}

/// The errors after a step, with the turn of the estimate that the innovation caused.
template <typename Scalar>
struct PolarErrorStep {
  PolarError<Scalar> error;  ///< (k+1|k+1); the phase error is continued, not wrapped into (-pi, pi]
  Scalar turn;               ///< arg z(k+1|k+1) - arg z(k+1|k), in (-pi, pi], rad
  Scalar turn_sine, turn_cosine;
};

/// The step of the errors under a given gain: prediction, innovation (cos chi - rho, -sin chi) + v'' with chi
/// the phase error of the prediction, and correction.
template <typename Scalar>
[[nodiscard]] PolarErrorStep<Scalar> error_step(const PolarError<Scalar>& error, const PolarGain<Scalar>& k,
                                                const PolarInput<Scalar>& input, const Scalar& epsilon) {
  using detail::sin_cos;
  using detail::square;
  using std::atan2;
  using std::sqrt;
  const Scalar rho = Scalar(1.0) + error.amplitude;
  const Scalar chi = error.phase + error.frequency;
  const auto [sine, cosine] = sin_cos(chi);
  const Scalar innovation_along = cosine - rho + input.noise_along;
  const Scalar innovation_across = input.noise_across - sine;
  const Scalar z1 = rho + k.k11 * innovation_along + k.k12 * innovation_across;
  const Scalar z2 = k.k12 * innovation_along + k.k22 * innovation_across;
  const Scalar correction = k.k31 * innovation_along + k.k32 * innovation_across;
  const Scalar length = sqrt(square(z1) + square(z2));
  const Scalar turn = atan2(z2, z1);
  const Scalar frequency_error =
      (Scalar(1.0) - epsilon) * error.frequency - epsilon * input.frequency - input.slew + correction;
  return {{length - Scalar(1.0), chi + turn, frequency_error}, turn, z2 / length, z1 / length};
}

/// Errors and covariance: the whole state of the closed loop.
template <typename Scalar>
struct PolarFrameState {
  PolarError<Scalar> error;
  PolarCovariance<Scalar> covariance;
};

/// One step of the closed loop, (k|k) to (k+1|k+1), for a signal of amplitude 1.
template <typename Scalar>
[[nodiscard]] PolarFrameState<Scalar> polar_frame_map(const PolarFrameState<Scalar>& state,
                                                      const PolarInput<Scalar>& input,
                                                      const ToneModel<Scalar>& design) {
  const Scalar rho = Scalar(1.0) + state.error.amplitude;
  const PolarCovariance<Scalar> predicted = predicted_covariance(state.covariance, rho, design);
  const PolarGain<Scalar> k = gain(predicted, design.r);
  const PolarErrorStep<Scalar> step = error_step(state.error, k, input, design.epsilon);
  // From the frame of the predicted phase into that of the filtered one: by -turn.
  return {step.error,
          turned(filtered_covariance(predicted, k, design.r), Scalar(-step.turn_sine), step.turn_cosine)};
}

/// The state of a filtered estimate, when the true signal is amplitude * e^{i phase} with this frequency
/// (rad/sample). P is scaled to amplitude 1; the phase error is wrapped into (-pi, pi]. Assumes z != 0.
template <typename Scalar>
[[nodiscard]] PolarFrameState<Scalar> to_polar_frame(const QuadratureEstimate<Scalar>& filtered,
                                                     const Scalar& amplitude, const Scalar& phase,
                                                     const Scalar& frequency) {
  using detail::sin_cos;
  using detail::square;
  using std::atan2;
  using std::sqrt;
  const Scalar length = sqrt(square(filtered.in_phase) + square(filtered.quadrature));
  const auto [sine, cosine] = sin_cos(phase);
  const Scalar phase_error = atan2(filtered.quadrature * cosine - filtered.in_phase * sine,
                                   filtered.in_phase * cosine + filtered.quadrature * sine);
  const PolarCovariance<Scalar> p =
      turned(PolarCovariance<Scalar>::from_matrix(filtered.covariance.matrix()),
             Scalar(-filtered.quadrature / length), Scalar(filtered.in_phase / length));
  const Scalar power = square(amplitude);
  return {{length / amplitude - Scalar(1.0), phase_error, filtered.frequency - frequency},
          {p.p11 / power, p.p12 / power, p.p13 / amplitude, p.p22 / power, p.p23 / amplitude, p.p33}};
}

}  // namespace veritrack::trackers
