// The values of a step at which remainders are gathered (docs/gain-proof.md, section 10).
#pragma once

#include <vector>

#include "trackers/model/straight_line_program.hpp"

namespace veritrack::model {

/// For each register the last value before the exit through which all that it does to the results passes;
/// -1 of a register that does nothing.
[[nodiscard]] std::vector<int> gates_of(const trackers::StraightLineProgram& program);

}  // namespace veritrack::model
