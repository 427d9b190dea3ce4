// The tube of a tracker over a cell of frequencies: its curve and its shape, proposed in floating point.
#pragma once

#include <optional>
#include <string>

#include "analysis/model/shape/proposed_tube.hpp"

namespace veritrack::model {

/// For |omega - frequency| <= half_width, rad/sample. `nearby`: parameters that were good at neighbouring
/// frequencies; with `keep` they are used as they are, so that tubes of neighbouring cells fit together.
/// Deterministic; holds round-to-nearest. Throws std::invalid_argument when sizes do not fit or the cell is
/// not within (0, pi).
[[nodiscard]] TubeProposal propose_tube(const TrackedTone& tone, double frequency, double half_width,
                                        const TubeSettings& settings,
                                        const std::optional<ShapeParameters>& nearby = std::nullopt,
                                        bool keep = false);

inline constexpr const char* kTimeLimit = "stopped by the time limit";

/// The failure in words and numbers, for a message; empty when nothing failed.
[[nodiscard]] std::string reason_of(const SteadyState& steady_state);
[[nodiscard]] std::string reason_of(const TubeProposal& proposal);

}  // namespace veritrack::model
