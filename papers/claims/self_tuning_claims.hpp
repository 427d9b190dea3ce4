// The assertions of chapter 5 of the thesis about least squares with condition number monitoring and the loop
// that it closes: lemma 5.2, theorem 5.2, (5.5), (5.23) and (5.24).
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::theorems {

/// The ids begin with "chapter-5/". No design enters. Needs the upward rounding mode.
[[nodiscard]] std::vector<Statement> self_tuning_claims();

}  // namespace veritrack::theorems
