// Sentences of P. Zarchan's slides on the matrices of the four filters: as derived there, and as the listings
// have them.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::theorems {

/// For the ledger of published claims. Needs the upward rounding mode.
[[nodiscard]] std::vector<Statement> sine_listing_claims();

}  // namespace veritrack::theorems
