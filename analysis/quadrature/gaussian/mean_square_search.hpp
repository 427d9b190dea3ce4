// Which quadratic form might bound the mean square of the frequency error in lock? Proposals in floating
// point; nothing here is evidence.
#pragma once

#include <optional>

#include "analysis/quadrature/gaussian/mean_square_inequality.hpp"

namespace veritrack::quadrature {

/// A proposal, and what the filter that is linearised about lock has in its steady state.
struct MeanSquareProposal {
  LockMeanSquare mean_square;  ///< with the bound that the sampled points of the set need
  double linear = 0.0;         ///< variance of the linear filter's frequency error, (rad/sample)^2
};

/// The steady variance of the frequency error of the filter linearised about lock, (rad/sample)^2, for the
/// noise and the walk of the set: the trace of the noise in the solution of a Lyapunov equation. Nothing when
/// it does not settle.
[[nodiscard]] std::optional<double> linear_frequency_variance(const trackers::ToneModel<double>& design,
                                                              const LockSet& set);

/// The form with the least bound that was found, points that need the most being added on the way. Without a
/// leak only. Deterministic; needs the upward mode.
[[nodiscard]] std::optional<MeanSquareProposal> propose_mean_square(const trackers::ToneModel<double>& design,
                                                                    const LockSet& set);

}  // namespace veritrack::quadrature
