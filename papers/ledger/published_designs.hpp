// The papers' own designs, which are part of the program, included by CMake.
#pragma once

#include <vector>

#include "certificates/help/texts.hpp"

namespace veritrack::reports::ledger {

/// The designs of designs/ that a paper prints, as they stand there.
[[nodiscard]] const std::vector<certificates::EmbeddedText>& published_designs();

}  // namespace veritrack::reports::ledger
