// The results that chapter 2 of the thesis builds on or competes with, for one design.
#pragma once

#include <vector>

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/tracker_input.hpp"

namespace veritrack::theorems {

/// Every result other than Theorem 2.9, each with its own id, in the order of the document.
/// If a result certifies a start or a noise bound for the tracker, its quantities
/// "initial_frequency_error_bound" (rad/sample), "noise_bound" (of |v(k)|, over the amplitude) and "rate"
/// (per step) give them; otherwise these are not applicable. Opens its own UpwardRounding scope. A few
/// milliseconds.
[[nodiscard]] std::vector<Derivation> evaluate_other_results(const TrackerInput& input);

}  // namespace veritrack::theorems
