// Which quadratic form might bound the mean square of the frequency error in lock? Proposals in floating
// point; nothing here is evidence.
#pragma once

#include <optional>

#include "analysis/quadrature/gaussian/mean_square_inequality.hpp"

namespace veritrack::quadrature {

/// The form with the least bound found; points of the set that need the most are added on the way. Its bound
/// is the one that the sampled points need. Nothing when the linearised filter does not settle.
/// Deterministic; needs the upward mode.
[[nodiscard]] std::optional<LockMeanSquare> propose_mean_square(const trackers::ToneModel<double>& design,
                                                                const LockSet& set);

}  // namespace veritrack::quadrature
