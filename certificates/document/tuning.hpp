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

/// The names of the trackers that can be tuned, as a sentence lists them: "a", "a or b".
[[nodiscard]] std::string trackers_with_tuning();

[[nodiscard]] bool can_be_tuned(const Design& design);

/// Chooses the free values of a design that can be tuned, for a small frequency error under what is assumed.
/// What the file is worth `certify` says. Throws std::logic_error for another design. Opens its own rounding
/// scopes.
[[nodiscard]] TuningResult tune(const Design& design);

}  // namespace veritrack::certificates
