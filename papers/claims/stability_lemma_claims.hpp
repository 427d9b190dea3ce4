// The lemmas and theorems on stability of chapter 2 of the thesis, decided as printed.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::theorems {

/// Lemmas 2.1 to 2.5, theorems 2.4, 2.6 and 2.8, corollary 2.6.1 and a sentence of section 2.2.4: the ids
/// begin with "chapter-2/". No design enters. Needs the upward rounding mode.
[[nodiscard]] std::vector<Statement> stability_lemma_claims();

}  // namespace veritrack::theorems
