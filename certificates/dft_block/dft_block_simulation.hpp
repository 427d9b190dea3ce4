// Simulated runs of a design of the block tracker, for its figure. Nothing here is proved.
#pragma once

#include <vector>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

struct BlockRun {
  double offset = 0.0;               ///< of the tone at the start, bins
  std::vector<double> offset_error;  ///< of the estimate after each block, bins
};

/// Tones at both ends and in the middle of the assumed offsets, which move by the assumed slew within them;
/// noise of the assumed length in random directions; starts with the assumed errors, in the steady state.
/// Nearest rounding is opened here.
[[nodiscard]] std::vector<BlockRun> simulate_blocks(const Certificate& certificate);

}  // namespace veritrack::certificates
