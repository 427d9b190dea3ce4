// By which factor does a step about the steady state contract the errors?
#pragma once

#include <vector>

#include "analysis/quadrature/leak/steady_bounds.hpp"
#include "analysis/quadrature/leak/steady_cell.hpp"

namespace veritrack::quadrature {

/// The rate of a step, proposed in double: the smallest one that some multipliers certify, and those.
struct SteadyRate {
  double rate_squared;
  double spread_multiplier;  ///< lambda
  double error_multiplier;   ///< mu
};

/// Proposal only. A rate of infinity when no multipliers work. A `target` above the rate moves the
/// multipliers to where that is certified with room to spare.
[[nodiscard]] SteadyRate propose_rate(const SteadyStep<double>& step, const SteadyBounds<double>& bounds,
                                      double target_squared);

/// True only when |c + N u + B y| <= rate for every |u| <= 1 and |y| <= eta, where c and N are constant and
/// slope of the step, B B' <= gram_factor gram + gram_rest I, for all states of the cell with these
/// corner_offsets; `eta_squared` holds eta^2 over the cell. With multipliers lambda, mu > 0 and h = rate^2 -
/// mu - lambda eta^2 > 0 it suffices that
///     c c'/h + N N'/mu + G/lambda < I:
/// for any vector x, by Cauchy and Schwarz, (x'(c + N u + B y))^2 <= (h + mu |u|^2 + lambda |y|^2) x'(c c'/h
/// + N N'/mu + B B'/lambda) x <= rate^2 |x|^2. Positive definite matrices form a convex set, so that it is
/// enough to look at the corners, with whichever slopes there are. Needs the upward mode.
[[nodiscard]] bool certainly_contracts(const SteadyStep<SteadySecant>& step,
                                       const SteadyBounds<rigor::Interval>& bounds,
                                       const rigor::Interval& eta_squared,
                                       const std::vector<SteadyOffset>& corners,
                                       const rigor::Interval& rate_squared,
                                       const SteadyRate& multipliers VERITRACK_CALL_SITE);

/// Certainly positive definite. Needs the upward mode.
[[nodiscard]] bool certainly_positive_definite(const Symmetric<rigor::Interval>& p VERITRACK_CALL_SITE);

}  // namespace veritrack::quadrature
