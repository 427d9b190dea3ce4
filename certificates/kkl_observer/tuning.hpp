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

/// Chooses the rates of a KKL observer with four filters for a small frequency error under the assumed
/// disturbance and a settling time of at most settles_within (without it: that of the given rates). The ell
/// is left to the certificate. What the file is worth `certify` says. Opens its own rounding scopes.
[[nodiscard]] TuningResult tune(const Design& design);

}  // namespace veritrack::certificates
