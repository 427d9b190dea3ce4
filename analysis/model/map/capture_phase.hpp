// The starts of a grid of deviations at one cell of phases.
#pragma once

#include <vector>

#include "analysis/model/map/capture_map.hpp"

namespace veritrack::model {

/// The outcome for a cell of the grid at one cell of phases.
enum class CaptureOutcome {
  not_wanted,
  captured,
  too_coarse,  ///< narrower cells of the phase may change this
  given_up
};

struct PhaseAnswer {
  std::vector<CaptureOutcome> outcomes;  ///< one for each cell
  std::vector<std::size_t> samples;      ///< of those that are captured
};

/// Follows sets of starts: all that are wanted together, which are divided where the polynomials do not keep
/// enough of a step. Deterministic. Needs the upward rounding mode.
[[nodiscard]] PhaseAnswer follow_at(const CaptureProblem& problem, const CaptureGrid& grid,
                                    const std::vector<char>& wanted, const CaptureOptions& options,
                                    const PhaseCell& phases);

}  // namespace veritrack::model
