// The quadrature tracker in its steady state along exact estimates of a tone of amplitude 1, to first order:
// its gains, how fast an error fades, what measurement noise does to the frequency, and how far the estimate
// lags behind a frequency that rises.
//
// In the frame of the estimated phase the amplitude separates, and phase and frequency obey the Kalman filter
// of F = [[1, 1], [0, 1 - epsilon]], H = (1, 0), Q = diag(q1, q2) and R = r. With the predicted covariance
// [[a, b], [b, c]] the gains are a/(a + r) and b/(a + r). For enclosures to hold of these numbers says
// nothing about large errors: it is the linear loop with which papers on the tracker argue.
#pragma once

#include <optional>

#include "analysis/rigor/interval.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::theorems {

struct SteadyLoop {
  rigor::Interval variance;    ///< a, predicted variance of the phase, rad^2
  rigor::Interval covariance;  ///< b, predicted covariance of phase and frequency
  rigor::Interval r, epsilon;  ///< of the design

  /// The gain of the innovation's phase, in (0, 1).
  [[nodiscard]] rigor::Interval phase_gain() const;
  /// The gain from the innovation's phase to the frequency, 1/sample.
  [[nodiscard]] rigor::Interval frequency_gain() const;
  /// det((I - K H) F) = (1 - phase_gain)(1 - epsilon): the product of the two factors by which a sample
  /// multiplies errors of phase and frequency, so that its root is the size of both where they are complex.
  [[nodiscard]] rigor::Interval squared_factor() const;
  /// Are the two factors certainly a complex pair?
  [[nodiscard]] bool oscillates() const;
  /// The frequency's constant error when it departs by `drift` a sample from the model's prediction,
  /// rad/sample: drift/(epsilon + b/a).
  [[nodiscard]] rigor::Interval lag(const rigor::Interval& drift) const;
  /// Its error, true minus estimated, when it has risen by `slew` a sample for ever and is now `frequency`.
  /// With A = (I - K H) F, the error of phase and frequency obeys e+ = A e + (0, slew + epsilon frequency),
  /// which has the solution (I - A)^-1 ((0, slew + epsilon frequency) - (I - A)^-1 (0, epsilon slew)).
  [[nodiscard]] rigor::Interval error_in_ramp(const rigor::Interval& frequency,
                                              const rigor::Interval& slew) const;
  /// Variance of the frequency estimate under white noise of variance `noise` in each channel,
  /// (rad/sample)^2; empty when the linear equations for it could not be solved.
  [[nodiscard]] rigor::Interval noise_variance(const rigor::Interval& noise) const;
};

/// Encloses the steady state: proposed by iteration, verified by the interval Newton operator (Moore 1966) on
/// the three equations of the covariance. The filter has one positive definite steady state, as Q > 0.
/// Nothing when none was verified. Needs the upward rounding mode.
[[nodiscard]] std::optional<SteadyLoop> steady_loop(const trackers::ToneModel<rigor::Interval>& design);

}  // namespace veritrack::theorems
