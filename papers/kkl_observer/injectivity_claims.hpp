// Sentences of Praly, Marconi and Isidori, section IV, on the injectivity of T: the printed Lipschitz
// constant, where none exists, and the factor 2 of (9).
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::kkl_observer {

/// For the ledger of published claims. Opens its own rounding scopes.
[[nodiscard]] std::vector<theorems::Statement> injectivity_claims();

}  // namespace veritrack::kkl_observer
