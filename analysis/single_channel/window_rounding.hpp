// The rounding of a step of the single-channel tracker in the states of a window (docs/rounding.md, "The
// single-channel tracker").
#pragma once

#include <optional>

#include "analysis/single_channel/step_rounding.hpp"
#include "analysis/single_channel/window_claim.hpp"

namespace veritrack::single_channel {

/// The properties of the tracked signal that matter to rounding.
struct TrackedSignal {
  rigor::Interval amplitude = rigor::Interval(1.0);  ///< signal units
  rigor::Interval band;                              ///< frequencies, rad/sample
  rigor::Interval noise = rigor::Interval(0.0);      ///< relative to the amplitude
};

/// P(0|0) from one diagonal matrix to another in the Loewner order.
struct StartRange {
  StartVariances lowest, highest;
};

/// For every state that satisfies the assumption, except for its rounding: after a step, or as a start whose
/// covariance is at least (1 - kMostCovariance) diag(floor, floor, q2), or, when given, in the range. Needs
/// the upward mode.
[[nodiscard]] StepRounding window_rounding(const trackers::ToneModel<rigor::Interval>& design,
                                           const TrackedSignal& signal, const WindowAssumption& assumption,
                                           const std::optional<StartRange>& start = std::nullopt);

}  // namespace veritrack::single_channel
