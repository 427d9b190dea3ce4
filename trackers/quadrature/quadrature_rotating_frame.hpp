// The quadrature tracker and its signal as one autonomous map.
//
// The filter of quadrature_ekf.hpp commutes with rotations of the plane: turn z and y by an angle, and P with
// them, and the estimates turn too. Let the true signal be s(k) = e^{i phi(k)}, phi(k+1) = phi(k) + omega(k),
// and write the filter in the frame that turns with phi(k) (rotating_frame.hpp). The result is a map of nine
// numbers X. A certificate about this map is a certificate about the tracker; tests tie the two together by
// an identity of values and first derivatives on dual numbers over intervals
// (tests/trackers/frame_identity_test.cpp).
//
// This is the filter of quadrature_ekf.hpp in other coordinates and in another order of evaluation: there,
// one that keeps its digits in floating point; here, one that repeats few variables, so that it stays narrow
// over boxes and makes sense for any P with det S != 0, definite or not.
#pragma once

#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/rotating_frame.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::trackers {

/// The inputs of the step from X(k) to X(k+1).
template <typename Scalar>
struct RotatingFrameInput {
  Scalar noise_in_phase;    ///< Re v', v' = e^{-i phi(k+1)} v(k+1); |v'| = |v|
  Scalar noise_quadrature;  ///< Im v'
  Scalar slew;              ///< w = omega(k+1) - omega(k), rad/sample
  Scalar frequency;         ///< omega(k), rad/sample; without effect when epsilon = 0
};

/// X(k+1) = G(X(k); v', w, omega), for a signal of amplitude 1: a time update that predicts in the frame of
/// the estimate (turned by omega + nu, so by nu beyond the true phase), the measurement update in that same
/// frame, and then the turn by nu into the frame of phi(k+1). Assumes det S != 0, S = H P(k+1|k) H' + r I.
template <typename Scalar>
[[nodiscard]] RotatingFrameState<Scalar> rotating_frame_map(const RotatingFrameState<Scalar>& state,
                                                            const RotatingFrameInput<Scalar>& input,
                                                            const ToneModel<Scalar>& design) {
  using detail::sin_cos;
  using detail::square;
  const Scalar one(1.0);
  const Scalar& r = design.r;
  const Scalar& p13 = state(kP13);
  const Scalar& p23 = state(kP23);
  const Scalar& p33 = state(kP33);
  const Scalar retention = one - design.epsilon;

  // Time update: F = [[I, g], [0, 1 - epsilon]] with g = J z, z = 1 + delta. The innovation covariance S and
  // the predicted P_z3.
  const Scalar z1 = one + state(kDeltaInPhase);
  const Scalar& z2 = state(kDeltaQuadrature);
  const Scalar noise = design.q1 + r;
  const Scalar s11 = state(kP11) + noise + square(z2) * p33 - z2 * (p13 + p13);
  const Scalar s12 = state(kP12) + z1 * (p13 - z2 * p33) - z2 * p23;
  const Scalar s22 = state(kP22) + noise + z1 * (z1 * p33 + (p23 + p23));
  const Scalar c1 = retention * (p13 - z2 * p33);
  const Scalar c2 = retention * (p23 + z1 * p33);

  // S^-1.
  const Scalar reciprocal = one / (s11 * s22 - square(s12));
  const Scalar i11 = s22 * reciprocal;
  const Scalar i12 = -(s12 * reciprocal);
  const Scalar i22 = s11 * reciprocal;

  // Innovation e^{-i nu} (1 + v') - z, and S^-1 times it.
  const auto [sine, cosine] = sin_cos(state(kFrequencyError));
  const Scalar y1 = one + input.noise_in_phase;
  const Scalar& y2 = input.noise_quadrature;
  const Scalar innovation1 = y1 * cosine + y2 * sine - z1;
  const Scalar innovation2 = y2 * cosine - y1 * sine - z2;
  const Scalar weighted1 = i11 * innovation1 + i12 * innovation2;
  const Scalar weighted2 = i12 * innovation1 + i22 * innovation2;

  // The measurement update leaves z + innovation - r S^-1 innovation. Turned by nu, z + innovation is 1 + v'
  // exactly.
  RotatingFrameState<Scalar> next;
  next(kDeltaInPhase) = input.noise_in_phase - r * (weighted1 * cosine - weighted2 * sine);
  next(kDeltaQuadrature) = input.noise_quadrature - r * (weighted1 * sine + weighted2 * cosine);
  next(kFrequencyError) = retention * state(kFrequencyError) - design.epsilon * input.frequency - input.slew +
                          c1 * weighted1 + c2 * weighted2;

  // P_zz = r I - r^2 S^-1, turned: the mean stays, the rest turns by twice the angle.
  const Scalar r_squared = square(r);
  const Scalar sine_squared = square(sine);
  const Scalar cosine_twice = one - (sine_squared + sine_squared);
  const Scalar sine_twice = (sine + sine) * cosine;
  const Scalar mean = Scalar(0.5) * (i11 + i22);
  const Scalar half_difference = Scalar(0.5) * (i11 - i22);
  const Scalar turned_difference = half_difference * cosine_twice - i12 * sine_twice;
  next(kP11) = r - r_squared * (mean + turned_difference);
  next(kP12) = -(r_squared * (half_difference * sine_twice + i12 * cosine_twice));
  next(kP22) = r - r_squared * (mean - turned_difference);

  // P_z3 = r S^-1 c, turned; P_33 = (1 - epsilon)^2 P_33 + q2 - c' S^-1 c.
  const Scalar d1 = i11 * c1 + i12 * c2;
  const Scalar d2 = i12 * c1 + i22 * c2;
  next(kP13) = r * (d1 * cosine - d2 * sine);
  next(kP23) = r * (d1 * sine + d2 * cosine);
  next(kP33) = square(retention) * p33 + design.q2 - (c1 * d1 + c2 * d2);
  return next;
}

}  // namespace veritrack::trackers
