// The assertions of the thesis about theorem 2.8, the theorems that it compares with, its design rules and
// its open questions, decided as printed.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::theorems {

/// Theorem 2.8 and section 2.2 (ids "chapter-2/...", and "picard/..." for the hypotheses of theorem 2.3),
/// section 3.5 to 3.7 ("chapter-3/...") and section 6.2 ("chapter-6/..."). No design of a file enters. Needs
/// the upward rounding mode.
[[nodiscard]] std::vector<Statement> tracker_theory_claims();

}  // namespace veritrack::theorems
