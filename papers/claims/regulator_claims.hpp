// Numerical assertions of section 3.5 and chapter 5 of the thesis that do not depend on our designs: the
// variance (3.12), the plant of the examples, and the bounds on P of the least squares with exponential
// forgetting and resetting (EFRA), as statements with verdicts.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::theorems {

/// With ids "chapter-3/..." and "chapter-5/...". Needs the upward mode.
[[nodiscard]] std::vector<Statement> regulator_claims();

}  // namespace veritrack::theorems
