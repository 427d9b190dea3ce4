// The allowance for rounding in the sets of the single-channel tracker (docs/rounding.md, "The single-channel
// tracker").
#pragma once

#include "analysis/single_channel/phase_sets.hpp"

namespace veritrack::single_channel {

/// For the rounding of a step in the sets of a claim, under that noise (relative to the amplitude): sixteen
/// times its bound, so that the checker's bound may be larger. Needs the upward mode.
[[nodiscard]] StepRounding allowed_rounding(const PhaseQuestion& question, const WindowClaim& claim,
                                            const rigor::Interval& noise);

/// Whether sixteen times the bound of the first step, from the range of starts of the set, is at most what
/// the set's claim allows. The set must have a start. Needs the upward mode.
[[nodiscard]] bool covers_start(const PhaseQuestion& question, const PhaseSet& set);

}  // namespace veritrack::single_channel
