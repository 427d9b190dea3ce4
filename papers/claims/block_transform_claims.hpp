// The assertions of chapter 4 of the thesis about the transform of a block and its linearisation, as
// statements with verdicts. They do not depend on a design.
#pragma once

#include <vector>

#include "analysis/statements/statement.hpp"

namespace veritrack::theorems {

/// Sections 4.2 to 4.4: (4.5), (4.6), (4.9), (4.16)-(4.17), (4.19)-(4.24), the rows of H at an integer
/// offset, and the effect of L, with ids "chapter-4/...". Needs the upward mode.
[[nodiscard]] std::vector<Statement> block_transform_claims();

}  // namespace veritrack::theorems
