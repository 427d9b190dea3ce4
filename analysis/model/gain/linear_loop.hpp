// The linear part of a loop's network, in floating point: for what engineers ask of it. Not evidence.
#pragma once

#include "analysis/linear/loop_response.hpp"
#include "analysis/model/gain/loop_network.hpp"

namespace veritrack::model {

/// Noise of deviation 1, signal units, in each channel; a step of the frequency by 1 rad/sample.
[[nodiscard]] linear::LinearLoop linear_loop(const LoopNetwork& network);

}  // namespace veritrack::model
