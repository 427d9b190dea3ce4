// The linear part of a loop's network, in floating point: for what engineers ask of it. Not evidence.
#pragma once

#include <optional>

#include "analysis/linear/loop_response.hpp"
#include "analysis/model/gain/loop_network.hpp"

namespace veritrack::model {

/// Noise of deviation 1, signal units, in each channel; a step of the frequency by 1 rad/sample.
[[nodiscard]] linear::LinearLoop linear_loop(const LoopNetwork& network);

/// Of the gain of its detector, where it has one; `amplitude` in signal units.
[[nodiscard]] std::optional<linear::GainMargin> detector_margin(const LoopNetwork& network, double amplitude);

}  // namespace veritrack::model
