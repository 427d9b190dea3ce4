// Where an interval of angles may contain multiples of pi/2. For use inside analysis/rigor.
#pragma once

#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor::detail {

/// False only when it is certain that x (in rad, not empty) contains (residue + j modulus) pi/2 for no
/// integer j.
/// Requires 0 <= residue < modulus and the upward mode.
[[nodiscard]] bool may_contain_quarter_turn(const Interval& x, int residue, int modulus);

}  // namespace veritrack::rigor::detail
