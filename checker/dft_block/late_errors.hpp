// The errors of the block tracker over time, from a verified set with its rate and from verified stages
// nearer to the exact lock: docs/block-tracker.md, section 4.
#pragma once

#include <vector>

#include "checker/dft_block/lock_check.hpp"

namespace veritrack::checker {

/// The verified rate and stages, in their order, and the starts.
struct BlockHistory {
  BlockRate rate;
  std::vector<BlockStage> stages;
  Ball start;  ///< |C^-1 z| of the first prediction, at most
};

struct BlockErrors {
  std::vector<Ball> offset;  ///< at most this from block 1 + i on, for ever, bins
  Ball ultimate;             ///< in the long run, bins
};

/// Stages that the errors or the covariances need not reach are not used; the flag tells whether all were.
BlockErrors block_errors(const BlockLock& lock, const BlockHistory& history, bool& all_reached);

}  // namespace veritrack::checker
