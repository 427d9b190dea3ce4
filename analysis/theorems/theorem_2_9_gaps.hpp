// The proof of Theorem 2.9 (La Scala, thesis 1994, chapter 2 and section 3.5), tested step by step: each
// possible gap is a statement with a verdict and a witness.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"
#include "analysis/theorems/theorem_2_9_constants.hpp"

namespace veritrack::theorems {

/// Every statement, decided for the design. Ids are "theorem-2.9/<place>", with "/printed", "/errata" or
/// "/repaired" where a place has a verdict in each reading. PROVED: the step is true, for the set or at the
/// witness that the sentence names; REFUTED: it is false, and the witness shows it. Statements that divide by
/// q1 are UNDECIDED when q1 may be zero. Same input conventions as evaluate_theorem_2_9. Opens its own
/// UpwardRounding scope.
[[nodiscard]] std::vector<Statement> theorem_2_9_gaps(const Theorem29Input& input);

}  // namespace veritrack::theorems
