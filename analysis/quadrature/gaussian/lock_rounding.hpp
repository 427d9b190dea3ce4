// Is the rounding of a step in double precision within the room that the drift inequality leaves?
#pragma once

#include "analysis/quadrature/gaussian/lock_set.hpp"
#include "analysis/quadrature/rounding/step_rounding.hpp"

namespace veritrack::quadrature {

/// Bounds on what the program adds to the errors and the covariance after the exact step, for every state of
/// the set and noise of at most `kMostDeviations` deviations a channel.
struct LockRounding {
  double error = 0.0;       ///< |T rho|
  double covariance = 0.0;  ///< mu: -mu P <= dP <= mu P for every P at or above lo of the largest level
  bool has_room = false;    ///< both are within kRoundingRoom: docs/gaussian.md, section 7
};

/// Noise beyond so many deviations in a channel, and a frequency that walks further than so many times w
/// sqrt(N), have a probability of at most `probability_beyond` together.
inline constexpr double kMostDeviations = 30.0;

/// For N samples of a signal. The set must have been verified. Needs the upward mode.
[[nodiscard]] LockRounding lock_rounding(const trackers::ToneModel<rigor::Interval>& design,
                                         const TrackedSignal& signal, const LockSet& set,
                                         const rigor::Interval& samples);

/// (4 N + 2) exp(-450): four tails of the noise a sample, two of the walk (Doob).
[[nodiscard]] rigor::Interval probability_beyond(const rigor::Interval& samples);

}  // namespace veritrack::quadrature
