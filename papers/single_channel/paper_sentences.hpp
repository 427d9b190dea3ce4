// Sentences of S. Bittanti and S. M. Savaresi (2000) beside their propositions, decided.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::single_channel {

/// Proposition 1 at the frequency 0 and for mirrored starts, (6) and (7), gains that vary, the bias over the
/// frequency, the effect of the leak, and lambda = 0. The design is that of Example 1 in the reading Q = q I.
/// About a second. Opens its own rounding scopes.
[[nodiscard]] std::vector<theorems::Statement> paper_sentences();

}  // namespace veritrack::single_channel
