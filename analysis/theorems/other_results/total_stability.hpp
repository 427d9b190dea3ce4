// The total stability theorem (thesis, theorem 2.6, after Anderson et al. 1986), its corollary 2.6.1 and
// theorem 2.7, applied to the error equation of the quadrature tracker.
//
// One run of the filter gives sequences of numbers: A(k) = (I - K(k)H) F(xhat(k|k)) and K(k).
// For these, e+ = A(k) e + f(k, e) + g(k) with
//     f(k, e) = (I - K(k)H)(f(x) - f(x - e) - F(xhat(k|k)) e),   g(k) = (I - K(k)H) w - K(k) v,
// functions of k and e alone: the dependence of K(k) on past errors, which the thesis ignores, is contained
// in the sequence. The price is that f is expanded about a point other than e = 0: its Lipschitz constant for
// |e| <= r is 2 |I - KH| curvature r. The bounds on A(k) need |e_j| <= r for j < k only, which the theorem
// has already proved at that step.
#pragma once

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// The conclusion of theorem 2.6 at step k >= 0: beta (alpha + zeta beta)^k |z_0| + beta eta r / (1 - (alpha
/// + zeta beta)). It bounds |z(k)|; that it is at most r, as printed, is not true, while |z(k)| <= r is.
/// Needs the upward rounding mode.
struct TotalStability {
  rigor::Interval beta, alpha, zeta, eta, radius;
};
[[nodiscard]] rigor::Interval total_stability_bound(const TotalStability& constants,
                                                    const rigor::Interval& start, int k);

/// id "total-stability": conditions beta (zeta + eta) + alpha < 1 and |e_0| < r/beta. Opens its own
/// UpwardRounding scope.
[[nodiscard]] Derivation evaluate_total_stability(const TrackerInput& input);

/// id "total-stability/corollary": no noise and no process noise; beta zeta + alpha < 1 and |e_0| < r/beta.
/// Opens its own UpwardRounding scope.
[[nodiscard]] Derivation evaluate_total_stability_corollary(const TrackerInput& input);

/// id "theorem-2.7/printed": zeta is twice the supremum of |Df|, which is at least the factor of an amplitude
/// error per step; so is alpha_2. The condition is refuted where three times that factor is 1 or more. Opens
/// its own UpwardRounding scope.
[[nodiscard]] Derivation evaluate_theorem_2_7_printed(const TrackerInput& input);

/// id "theorem-2.7/corrected": zeta as the proof needs it, the supremum of |Df(z + d) - Df(z)| for |z| <=
/// beta_1 r_z, |d| <= r_x - beta_1 r_z. Opens its own UpwardRounding scope.
[[nodiscard]] Derivation evaluate_theorem_2_7_corrected(const TrackerInput& input);

}  // namespace veritrack::theorems
