// By which factor does a step about the steady state contract the errors?
#pragma once

#include <array>
#include <vector>

#include "analysis/quadrature/leak/steady_bounds.hpp"
#include "analysis/quadrature/leak/steady_cell.hpp"

namespace veritrack::quadrature {

/// The multipliers of the inequality of certainly_contracts.
struct SteadyMultipliers {
  double hidden;      ///< mu, of the part of the error that (alpha, c) do not see
  double spread;      ///< lambda, of the spread of the gain
  double noise;       ///< sigma
  double cell = 0.0;  ///< tau, of the size of the cell
};

/// The rate of a step, proposed in double: the smallest one that some multipliers certify, and those.
struct SteadyRate {
  double rate_squared;
  SteadyMultipliers multipliers;
};

/// The data that decide the rate of a step: the lengths of image + t hidden + B y + N v with t^2 <=
/// hidden_squared, |y|^2 <= eta_squared, |v|^2 <= noise_squared.
struct SteadyReach {
  std::array<double, 3> image, hidden;
  Symmetric<double> gram, noise;  ///< B B' and N N'
  double hidden_squared, eta_squared, noise_squared;
};

/// The reach of a step in double; `noise` is relative to the amplitude.
[[nodiscard]] SteadyReach reach_of(const SteadyStep<double>& step, const SteadyBounds<double>& bounds,
                                   const SteadySetting<double>& setting, double level, double noise);

/// Proposal only. A rate of infinity when no multipliers work. A `target` above the rate moves the
/// multipliers to where that is certified with room to spare.
[[nodiscard]] SteadyRate propose_rate(const SteadyReach& reach, double target_squared);

/// The middles of the slopes of the image in x and in y.
[[nodiscard]] std::array<std::array<double, 3>, 2> middle_slopes(const SteadyStep<SteadySecant>& step);

/// True only when |image + t hidden + B y + N v| <= rate for every t^2 <= 1 - x^2 - y^2,
/// |y|^2 <= eta_factor eta^2 + eta_rest and |v|^2 <= noise_squared, where image, B B' = gram and N = noise
/// are those of the step, for all states of the cell with this middle of (x, y) and these corner_offsets.
/// With multipliers mu, lambda, sigma > 0 and
///     h = rate^2 - mu (1 - x^2 - y^2) - lambda (eta_factor eta^2 + eta_rest) - sigma noise_squared > 0
/// it suffices that
///     image image'/h + hidden hidden'/mu + gram/lambda + N N'/sigma < I:
/// for any vector z, by Cauchy and Schwarz, (z'(image + t hidden + B y + N v))^2 <= (h + mu t^2 + lambda
/// |y|^2 + sigma |v|^2) z'(image image'/h + hidden hidden'/mu + B B'/lambda + N N'/sigma) z <= rate^2 |z|^2.
/// With d the way of (x, y) from the middle c, any constant matrix S, A = I - hidden hidden'/mu - gram/lambda
/// - N N'/sigma, image = p + S d and h = g + 2 mu c'd + mu |d|^2, it is implied by
///     (A  S  p; S'  mu I  mu c; p'  mu c'  g) > 0,
/// as the vector (-w, d, 1) shows, w = A^-1 (p + S d). There x and y enter without the secant of a square.
/// For d in the cell, |d|^2 <= r^2, any tau >= 0 may be added to both mu of the second row when tau r^2 is
/// taken from g. Positive definite matrices form a convex set, so that it is enough to look at the corners,
/// with whichever slopes there are. Needs the upward mode.
[[nodiscard]] bool certainly_contracts(const SteadyStep<SteadySecant>& step,
                                       const SteadyBounds<rigor::Interval>& bounds,
                                       const std::array<rigor::Interval, 3>& hidden, const SteadyCell& cell,
                                       const rigor::Interval& noise_squared,
                                       const std::vector<SteadyOffset>& corners,
                                       const rigor::Interval& rate_squared,
                                       const SteadyMultipliers& multipliers VERITRACK_CALL_SITE);

/// Certainly positive definite. Needs the upward mode.
[[nodiscard]] bool certainly_positive_definite(const Symmetric<rigor::Interval>& p VERITRACK_CALL_SITE);

}  // namespace veritrack::quadrature
