// The published results beside Theorem 2.9, evaluated for the design: closed formulas
// (docs/published-results.md).
#pragma once

#include <string>

#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// Is there a check for this derivation?
bool is_published_result(const std::string& id);

/// Objects to every statement of the derivation that could not be re-established.
std::string check_published_result(const std::string& id, const Tree& derivation, const Design& design,
                                   Objections& objections);

}  // namespace veritrack::checker
