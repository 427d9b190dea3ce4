// Sound bounds on the covariances of the quadrature tracker while its filtered estimates keep |z| in a band:
// riccati_bounds.hpp for the window N = 1, in closed form.
//
// In the frame of the estimate at k-1 one has F = [[1, 0, 0], [0, 1, m], [0, 0, 1 - epsilon]] up to a turn,
// m = |z(k-1|k-1)|, and with mu = m/(1 - epsilon) amplitude and (phase, frequency) separate:
//     O^-1 + B W B' = diag(r/2 + q1/4) + [[r, r/mu], [r/mu, (2r + q1)/mu^2 + q2]].
// The second block is P(k|k) itself for an infinite prior: two measurements determine phase and frequency,
// and no other unbiased estimator exists. For the amplitude it is r(r + q1)/(2r + q1), less than the bound.
// The information bound is Q^-1 + H'H/r for every m. All functions need the upward rounding mode.
#pragma once

#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// The supremum over all priors of the largest eigenvalue of the (phase, frequency) block of P(k|k), for
/// m = |z(k-1|k-1)|, once y(k-1) and y(k) are processed. Decreasing in m.
[[nodiscard]] rigor::Interval attained_covariance(const Theorem29Input& input, const rigor::Interval& m);

/// A bound on |P(k|k)| for every m in the operand, once y(k-1) and y(k) are processed: the above at the lower
/// end of m, or the amplitude's r/2 + q1/4.
[[nodiscard]] rigor::Interval largest_covariance(const Theorem29Input& input, const rigor::Interval& m);

/// A bound on |P(k|k)^-1| for k >= 1: max(1/q1 + 1/r, 1/q2). Empty when q1 may be zero.
[[nodiscard]] rigor::Interval largest_information(const Theorem29Input& input);

/// smallest I <= P(k|k) <= largest I.
struct CovarianceRange {
  rigor::Interval smallest, largest;
};

/// Valid for every k >= 0 as long as the filtered estimates before k have | |z| - 1 | <= radius. The steady
/// state satisfies the window bounds, since its past is itself, if its |z| lies in the band (it is 1 for
/// epsilon = 0); a given P(0|0) widens the range to include P(0|0) and a bound on P(1|1).
[[nodiscard]] CovarianceRange covariance_range(const TrackerInput& input, const rigor::Interval& radius);

}  // namespace veritrack::theorems
