// Table 3.1 of the thesis: how alpha and beta of Theorem 2.9 change with q1, q2 and r, decided over a box of
// designs.
#pragma once

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// id "table-3.1/printed" or "table-3.1/errata": the sign of each derivative over the box in which q1, q2 and
/// r are between half and twice the design's, by subdivision and automatic differentiation; r_alpha and
/// r_beta, where alpha and beta are stationary in r, enclosed and compared with their formulas. Opens its own
/// UpwardRounding scope.
///
/// The table is for q1 <= q2 (thesis, page 69: "the constraint that q1 <= q2", and its footnote, which gives
/// the opposite signs for q1 > q2). Unless the design is certain to satisfy that, nothing is decided, and the
/// quantities are not applicable. The signs are proved for the printed p, q and s over the whole box, and so
/// for the part of it in which q1 <= q2.
///
/// With p = q2 + B1 r, q = 1/q1 + B2/r, s = q + rho1^2/q1 (B1 = 1/(r b1), B2 = r b2, both independent of r)
/// one has
/// beta^2 = p q and 1 - alpha^2 = gamma/q = gamma_fraction/(s p^2 q), so the signs asked for are those of the
/// derivatives of p q and s p^2 q. Both are sums of positive multiples of powers of r: convex in log r on a
/// logarithmic scale, with one stationary point at most, a minimum.
[[nodiscard]] Derivation evaluate_table_3_1(Theorem29Variant variant, const TrackerInput& input);

}  // namespace veritrack::theorems
