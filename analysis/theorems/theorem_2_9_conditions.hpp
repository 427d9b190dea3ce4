// The hypotheses of Theorem 2.9, decided for a design.
#pragma once

#include <vector>

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/theorem_2_9_constants.hpp"

namespace veritrack::theorems {

/// The ranges of the free parameters, the standing assumptions and (2.43) to (2.45), each with its verdict
/// and the reason. (2.43) and (2.44) are decided against 1 - alpha; their lhs is that of the thesis, their
/// rhs 1. Needs the upward rounding mode.
[[nodiscard]] std::vector<Condition> theorem_2_9_conditions(Theorem29Variant variant,
                                                            const Theorem29Input& input,
                                                            const Theorem29Constants& constants);

}  // namespace veritrack::theorems
