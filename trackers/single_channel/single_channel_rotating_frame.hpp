// The single-channel tracker and its signal as one map over the phase.
//
// Let the true signal be s(k) = cos phi(k), phi(k+1) = phi(k) + omega(k), and write the filter of
// single_channel_ekf.hpp in the frame that turns with phi(k): the nine numbers X of rotating_frame.hpp, and
// Q = diag(q1, q1, q2), which a turn leaves alone. The measured direction h = (1, 0) becomes (cos phi, -sin
// phi), so that X(k+1) depends on the phase: a skew product over phi(k+1) = phi(k) + omega(k). Turned by pi,
// h changes its sign, and so do innovation and gain: the map is pi-periodic in phi.
//
// Certificates are about this map. Tests tie it to the filter, by an identity of values and first derivatives
// on dual numbers over intervals (tests/trackers/frame_identity_test.cpp).
#pragma once

#include "trackers/rotating_frame.hpp"
#include "trackers/scalar_functions.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace veritrack::trackers {

/// The inputs of the step from X(k) to X(k+1).
template <typename Scalar>
struct SingleChannelInput {
  Scalar next_phase;  ///< phi(k+1), rad
  Scalar noise;       ///< v(k+1), relative to the amplitude
  Scalar slew;        ///< w = omega(k+1) - omega(k), rad/sample
  Scalar frequency;   ///< omega(k), rad/sample; without effect when epsilon = 0
};

/// The single-channel filter of a model: Q = diag(q1, q1, q2).
template <typename Scalar>
[[nodiscard]] inline SingleChannelEkfDesign<Scalar> single_channel_design(const ToneModel<Scalar>& design) {
  return {diagonal_process_noise(design.q1, design.q2), design.r, design.epsilon};
}

/// X(k+1) from X(k), for a signal of amplitude 1: a time update and a measurement update in the frame of the
/// prediction, which is nu ahead of phi(k+1), and then the turn by nu. Assumes an innovation variance other
/// than 0.
template <typename Scalar>
[[nodiscard]] RotatingFrameState<Scalar> single_channel_map(const RotatingFrameState<Scalar>& state,
                                                            const SingleChannelInput<Scalar>& input,
                                                            const ToneModel<Scalar>& design) {
  using detail::sin_cos;
  using detail::square;
  const Scalar one(1.0);
  const Scalar& p33 = state(kP33);
  const Scalar retention = one - design.epsilon;

  // Time update: F = [[I, g], [0, 1 - epsilon]] with g = J z, z = 1 + delta.
  const Scalar z1 = one + state(kDeltaInPhase);
  const Scalar& z2 = state(kDeltaQuadrature);
  const Scalar m13 = state(kP13) - z2 * p33;  // P_z3 + g P_33
  const Scalar m23 = state(kP23) + z1 * p33;
  const Scalar n11 = state(kP11) + design.q1 - z2 * (state(kP13) + m13);
  const Scalar n12 = state(kP12) + z1 * m13 - z2 * state(kP23);
  const Scalar n22 = state(kP22) + design.q1 + z1 * (state(kP23) + m23);
  const Scalar c1 = retention * m13;
  const Scalar c2 = retention * m23;

  // The measured direction in this frame, P h, and the innovation.
  const auto [sine_true, cosine_true] = sin_cos(input.next_phase);
  const auto [sine_seen, cosine_seen] = sin_cos(input.next_phase + state(kFrequencyError));
  const Scalar b1 = n11 * cosine_seen - n12 * sine_seen;
  const Scalar b2 = n12 * cosine_seen - n22 * sine_seen;
  const Scalar b3 = c1 * cosine_seen - c2 * sine_seen;
  const Scalar reciprocal = one / (b1 * cosine_seen - b2 * sine_seen + design.r);
  const Scalar weighted = (cosine_true + input.noise - (z1 * cosine_seen - z2 * sine_seen)) * reciprocal;

  // Measurement update, and the turn by nu.
  const auto [sine, cosine] = sin_cos(state(kFrequencyError));
  const Scalar x1 = z1 + b1 * weighted;
  const Scalar x2 = z2 + b2 * weighted;
  const Scalar e13 = c1 - b1 * b3 * reciprocal;
  const Scalar e23 = c2 - b2 * b3 * reciprocal;
  const Scalar e11 = n11 - square(b1) * reciprocal;
  const Scalar e12 = n12 - b1 * b2 * reciprocal;
  const Scalar e22 = n22 - square(b2) * reciprocal;
  const Scalar sine_squared = square(sine);
  const Scalar cosine_twice = one - (sine_squared + sine_squared);
  const Scalar sine_twice = (sine + sine) * cosine;
  const Scalar mean = Scalar(0.5) * (e11 + e22);
  const Scalar half_difference = Scalar(0.5) * (e11 - e22);
  const Scalar turned_difference = half_difference * cosine_twice - e12 * sine_twice;

  RotatingFrameState<Scalar> next;
  next(kDeltaInPhase) = x1 * cosine - x2 * sine - one;
  next(kDeltaQuadrature) = x1 * sine + x2 * cosine;
  next(kFrequencyError) =
      retention * state(kFrequencyError) - design.epsilon * input.frequency - input.slew + b3 * weighted;
  next(kP11) = mean + turned_difference;
  next(kP12) = half_difference * sine_twice + e12 * cosine_twice;
  next(kP13) = e13 * cosine - e23 * sine;
  next(kP22) = mean - turned_difference;
  next(kP23) = e13 * sine + e23 * cosine;
  next(kP33) = square(retention) * p33 + design.q2 - square(b3) * reciprocal;
  return next;
}

}  // namespace veritrack::trackers
