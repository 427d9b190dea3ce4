// The results that chapter 2 of the thesis builds on or competes with, for one design.
#pragma once

#include <vector>

#include "analysis/theorems/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// Every result beside Theorem 2.9, each with an id of its own, in the order in which a reader meets them.
/// Where a result certifies something for the tracker, its quantities "initial_frequency_error_bound"
/// (rad/sample), "noise_bound" (of |v(k)|, over the amplitude) and "rate" (a step) say what; they are not
/// applicable where it certifies nothing. Opens its own UpwardRounding scope. A few milliseconds.
[[nodiscard]] std::vector<Derivation> evaluate_other_results(const TrackerInput& input);

}  // namespace veritrack::theorems
