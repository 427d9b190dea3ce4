// Where a design says that the states of a program are.
#pragma once

#include "certificates/design/design.hpp"
#include "certificates/model/tie/drawn_steps.hpp"

namespace veritrack::certificates::tie {

/// Angles in the range that the program's wraps keep them in; the state that the frequency is read from in
/// the assumed band, and an eighth of it beyond; samples of the assumed amplitude and noise.
[[nodiscard]] DrawRanges draw_ranges(const Design& design);

}  // namespace veritrack::certificates::tie
