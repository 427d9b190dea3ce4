// Can the conditions of Theorem 2.9 be satisfied for some choice of its free parameters?
#pragma once

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/theorem_2_9_constants.hpp"

namespace veritrack::theorems {

/// No: REFUTED for every design, by a lower bound on the left side of (2.43). With t = sqrt(2) sigma in (0,
/// 1) in print, and sigma in (0, 1) in the errata,
///     printed  b_2/b_1 = 6 (2 - t)^2 / (t^2 (1 - t^2/4)) >= 6 / (3/4) = 8,   errata  b_2/b_1 = 10/sigma >=
///     10; p q = (a_1 + 1/b_1)(1/a_2 + b_2) >= b_2/b_1;   rho_1 = 2 (R_x + epsilon_r) >= 2 R_x; beta (zeta +
///     eta) + alpha >= beta eta >= sqrt(p q) 2 p q rho_1 >= 4 (b_2/b_1)^(3/2) R_x,
/// which does not depend on the design; and R_x >= |x(k)| >= 1 on the unit circle. `lower_bound` is the
/// sharper bound that the design's q1, q2 and r give when all the free parameters are replaced by the ends
/// that make p, q and s least; `best_found` is the best point that NLopt found, over sigma (which stands for
/// epsilon_r), gamma_fraction, c1 and c2. `input`'s own free parameters are not used. Opens its own
/// UpwardRounding scope.
[[nodiscard]] Feasibility theorem_2_9_feasibility(Theorem29Variant variant, const Theorem29Input& input);

}  // namespace veritrack::theorems
