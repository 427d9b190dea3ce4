// Free design values, chosen for the best guarantee.
#pragma once

#include <optional>
#include <string>

#include "certificates/design/design.hpp"

namespace veritrack::certificates {

/// A design file with other values, or why there is none.
struct TuningResult {
  std::optional<std::string> design_text;  ///< a whole design file, TOML
  std::string reason;                      ///< one sentence when there is none
};

/// Chooses the free values of a design for a small frequency error under what is assumed. A kind of tracker
/// that has nothing to choose is answered with a sentence. What the file is worth `certify` says. Opens its
/// own rounding scopes.
[[nodiscard]] TuningResult tune(const Design& design);

}  // namespace veritrack::certificates
