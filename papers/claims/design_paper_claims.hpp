// Sentences of B. F. La Scala and R. R. Bitmead, "Design of an extended Kalman filter frequency tracker",
// IEEE Trans. Signal Processing 44(3), 1996: about its model, Lemma 1, and the four designs of its Figures 1,
// 3, 4 and 5, which are those of Table 3.2 of the thesis.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::theorems {

/// Sections II to V: model, over- and under-design, Q, slew. For the ledger of published claims.
/// Needs the upward rounding mode.
[[nodiscard]] std::vector<Statement> design_paper_claims();

/// Lemma 1, and the consequences of the theorem behind it for the designs. Needs the upward rounding mode.
[[nodiscard]] std::vector<Statement> design_paper_lemma_claims();

/// Sections IV and V: what Q, R and the leak of the four designs do, on the tracker linearised about a tone
/// of amplitude 1 (steady_loop.hpp). Needs the upward rounding mode.
[[nodiscard]] std::vector<Statement> design_paper_loop_claims();

}  // namespace veritrack::theorems
