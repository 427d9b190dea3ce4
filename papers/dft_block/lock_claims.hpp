// The assertions of chapter 4 of the thesis about the block tracker's starts, as statements with verdicts.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::dft_block {

/// Section 4.5.2, that the start decides whether the filter ever finds the tone: for each of the three
/// designs of section 4.5 at its nearest range, a set of starts one bin off that is never left. With ids
/// "chapter-4/initial-estimate/...". Needs the upward mode.
[[nodiscard]] std::vector<theorems::Statement> lock_claims();

}  // namespace veritrack::dft_block
