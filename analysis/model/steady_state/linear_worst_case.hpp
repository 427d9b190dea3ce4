// The size of frequency errors under bounded noise and slew to first order: an estimate in floating point,
// with which a proved bound is compared.
#pragma once

#include <optional>

#include "analysis/model/steady_state/steady_state.hpp"

namespace veritrack::model {

/// The frequency error in the long run, rad/sample, at one frequency of the tone.
struct LinearWorstCase {
  double frequency = 0.0;    ///< rad/sample
  double undisturbed = 0.0;  ///< the largest without noise and slew
  double disturbed = 0.0;    ///< the largest with both
};

/// Along the curve of the steady state a small deviation d and the error of the estimate obey
///   d(phi + omega) = A(phi) d(phi) + B(phi) v - C_omega w,   error = h(C) - omega + h_X d,
/// with the derivatives A, B of the step and C_omega of the curve. The largest error for |v| <= `noise`,
/// signal units, and |w| <= `slew`, rad/sample per sample, is |h(C) - omega| + sum_j (noise |h_X A ... A B| +
/// slew |h_X A ... A C_omega|), over the samples j before the phase, at the worst of `phases` phases; plus
/// the contribution of amplitudes that vary. Nonlinear terms are left out, in either direction: not a bound.
/// Empty where no steady state is found. Throws std::invalid_argument unless noise >= 0, slew >= 0 and phases
/// > 0.
[[nodiscard]] std::optional<LinearWorstCase> linear_worst_case(const TrackedTone& tone, double frequency,
                                                               double noise, double slew, int phases = 48);

}  // namespace veritrack::model
