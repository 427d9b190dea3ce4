// Proposals of stages near the exact lock: in floating point, and not evidence of anything.
#pragma once

#include <optional>

#include "analysis/dft_block/lock_search.hpp"

namespace veritrack::dft_block {

/// A stage for such errors in the search's frame, a little worse than samples in it: the bounds on
/// the covariances by the factor `room`, and the more there is the sooner they are reached. Empty when there
/// are none.
[[nodiscard]] std::optional<LateStage> propose_stage(const LockSearch& search, const ErrorSet& errors,
                                                     double room);

}  // namespace veritrack::dft_block
