// A recursion for the size of the quadrature tracker's estimation error, in the norm of its own covariance:
//     W(k) = sqrt(e(k)' P(k|k)^-1 e(k)),   e(k) = x(k) - xhat(k|k).
// For a signal of amplitude 1 with frequency noise w(k) (x3(k+1) = (1 - epsilon) x3(k) + w(k)) and
// measurement noise v(k), as long as every estimate stays in a tube around the signal,
//     W(k+1) <= alpha W(k) + c W(k)^2 + g_w |w(k)| + g_v |v(k+1)|.
// The proof is docs/repaired-theorem.md. P(k|k) is the filter's actual covariance for any past: only the
// bounds of tracker_covariance.hpp on it are used, and nothing is differentiated.
#pragma once

#include <optional>

#include "analysis/rigor/verdict.hpp"
#include "analysis/theorems/tracker_covariance.hpp"

namespace veritrack::theorems {

/// The constants of the recursion, and where it is valid.
struct ErrorRecursion {
  ErrorBounds tube;
  int window = 0;  ///< N of the Riccati bounds, samples; 0: the range of invariant_covariance.hpp
  MatrixRange range;

  rigor::Interval alpha;             ///< factor of the linear part, in [0, 1)
  rigor::Interval one_minus_alpha;   ///< without cancellation
  rigor::Interval curvature;         ///< c, of the linearisation error
  rigor::Interval process_gain;      ///< g_w, per rad/sample
  rigor::Interval measurement_gain;  ///< g_v, per signal unit

  rigor::Interval p;               ///< P(k|k) <= p I
  rigor::Interval q;               ///< P(k|k)^-1 <= q I
  rigor::Interval s;               ///< P(k+1|k) <= s I
  rigor::Interval plane_gain;      ///< |z(k|k) - z(k)| <= plane_gain W(k), signal units
  rigor::Interval frequency_gain;  ///< |x3(k|k) - x3(k)| <= frequency_gain W(k), rad/sample
  /// W(k) at most this keeps the estimate in the tube.
  rigor::Interval tube_radius;

  /// alpha R + c R^2 + `disturbance` <= R <= tube_radius for a point R: a start with W(0) <= R keeps W(k) <=
  /// R for ever when g_w |w| + g_v |v| <= disturbance.
  [[nodiscard]] rigor::Verdict decide_invariant(const rigor::Interval& radius,
                                                const rigor::Interval& disturbance) const;
  /// A point near the largest R of decide_invariant, by floating point: a proposal. Empty when none was
  /// found.
  [[nodiscard]] rigor::Interval propose_radius(const rigor::Interval& disturbance) const;
  /// The R that tolerates the largest disturbance, a point: (1 - alpha)/(2 c), or the end of the tube.
  [[nodiscard]] rigor::Interval toughest_radius() const;
  /// That disturbance, (1 - alpha) R - c R^2.
  [[nodiscard]] rigor::Interval largest_disturbance() const;
  /// An upper bound on limsup W(k) when W(0) is below the larger root of alpha R + c R^2 + disturbance = R:
  /// the smaller root. Empty when there is none.
  [[nodiscard]] rigor::Interval ultimate_radius(const rigor::Interval& disturbance) const;
};

/// The recursion for a tube and a window (see ErrorRecursion::window); nothing where a bound is not finite or
/// alpha is not certainly below
/// 1. Needs the upward rounding mode.
[[nodiscard]] std::optional<ErrorRecursion> error_recursion(const IntervalDesign& design,
                                                            const ErrorBounds& tube, int window);

}  // namespace veritrack::theorems
