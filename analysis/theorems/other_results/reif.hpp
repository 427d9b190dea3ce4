// K. Reif, S. Guenther, E. Yaz, R. Unbehauen, "Stochastic stability of the discrete-time extended Kalman
// filter", IEEE Trans. Automatic Control 44(4), 1999, theorem 3.1, for a design of the quadrature tracker.
#pragma once

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// id "reif-1999": the constants as published, for the one-step filter the paper treats (it linearises at the
/// prediction; P there is P(k|k-1)). V = e'P^-1 e decreases while |e| <= epsilon' and |e| <= alpha/(2 p_hi
/// kappa). The paper concludes from |e_0| <= epsilon that |e_k| stays there; this needs the factor sqrt(p_lo
/// / p_hi). Noise needs a further condition. Both are conditions here. Opens its own UpwardRounding
/// scope.
[[nodiscard]] Derivation evaluate_reif(const TrackerInput& input);

/// id "reif-1999/two-step": the same argument carried out for the tracker's own two-step filter
/// (error_equation.hpp), with the triangle inequality in the norm sqrt(e'P^-1 e) in place of cubic terms:
///     |e+| <= (alpha + L |e|) |e| + |w|/sqrt(q_lo) + |v|/sqrt(r),   L = (curvature/2) sqrt(p_hi/q_lo).
[[nodiscard]] Derivation evaluate_reif_two_step(const TrackerInput& input);

}  // namespace veritrack::theorems
