// How far the state of a tracker in double precision can be from the state that real arithmetic gives
// (docs/rounding.md).
#pragma once

#include <limits>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/rounded.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::sets {

/// The upper end; infinity when there is none.
[[nodiscard]] inline double upper_or_infinite(const rigor::Interval& x) {
  return rigor::is_finite(x) ? x.upper() : std::numeric_limits<double>::infinity();
}

/// The inputs of the program, besides its state. Lengths are relative to the true amplitude.
struct Program {
  trackers::ToneModel<rigor::Interval> design;
  rigor::Interval amplitude = rigor::Interval(1.0);  ///< the true one, signal units
  double largest_measurement = 1.0;                  ///< of |y|: 1 and the noise
  double largest_frequency = 0.0;                    ///< of |x3(k|k)|, rad/sample
};

/// Bounds on the difference of two states, in any orientation: of z the length, of P the norms of its blocks.
struct StateDifference {
  double z = 0.0;          ///< relative to the true amplitude
  double frequency = 0.0;  ///< rad/sample
  double p_zz = 0.0;       ///< spectral norm of the 2x2 block
  double p_z3 = 0.0;       ///< length
  double p_33 = 0.0;       ///< absolute value
};

/// The larger of each; neither may be NaN.
[[nodiscard]] StateDifference larger(const StateDifference& a, const StateDifference& b);

/// True only when all five are finite.
[[nodiscard]] bool is_finite(const StateDifference& difference);

/// The difference of the program's state from the exact one; both covariances are given by factors: P_zz = M
/// + d u u', P_z3 = d u, P_33 = d. Needs the upward mode.
[[nodiscard]] StateDifference difference_of(const trackers::ToneEstimate<rigor::Rounded>& after);

}  // namespace veritrack::sets
