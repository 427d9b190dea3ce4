// Sentences of S. Bittanti and S. M. Savaresi, 2000, on the recursion (2) as it is printed: where its F(t) is
// evaluated, and its I3.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::single_channel {

/// For the ledger of published claims. Needs the upward rounding mode.
[[nodiscard]] std::vector<theorems::Statement> printed_recursion_claims();

}  // namespace veritrack::single_channel
