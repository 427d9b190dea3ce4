// Sentences of the KKL observer's paper beside those that its certificates decide (kkl_claims.hpp).
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::kkl_observer {

/// (16) and (17), ell > 0, steps of section IV, and the bandwidth and errors of section V. No design of a
/// file enters. Ids begin with "kkl-paper/". Some tenths of a second. Opens its own rounding scope.
[[nodiscard]] std::vector<theorems::Statement> paper_sentences();

}  // namespace veritrack::kkl_observer
