// Functions with kinks and jumps, as code.
#pragma once

#include <string>
#include <vector>

#include "certificates/model/recursion_text.hpp"
#include "trackers/model/straight_line_program.hpp"

namespace veritrack::certificates {

/// The definitions of those that the programs call, in C, Python or Octave, each followed by an empty line.
/// They return the same doubles as trackers/model/piecewise.hpp.
[[nodiscard]] std::string piecewise_code(const std::vector<const trackers::StraightLineProgram*>& programs,
                                         CodeLanguage language);

}  // namespace veritrack::certificates
