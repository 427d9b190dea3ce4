// What the thesis says of theorem 2.8, of the theorems that it compares with, of its design rules and of what
// is left to do, decided as it is printed.
#pragma once

#include <vector>

#include "analysis/theorems/statement.hpp"

namespace veritrack::theorems {

/// Theorem 2.8 and section 2.2 (ids "chapter-2/...", and "picard/..." for the hypotheses of theorem 2.3),
/// section 3.5 to 3.7 ("chapter-3/...") and section 6.2 ("chapter-6/..."). No design of a file enters. Needs
/// the upward rounding mode.
[[nodiscard]] std::vector<Statement> tracker_theory_claims();

}  // namespace veritrack::theorems
