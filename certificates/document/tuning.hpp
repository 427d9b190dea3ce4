// Free design values, chosen for the best guarantee.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/design/design.hpp"

namespace veritrack::certificates {

/// What is wanted of the tuned design.
struct TuningRequest {
  std::string design_text;  ///< the file, whose words and order are kept where that is possible
  std::string objective;    ///< one of `tuning_objectives`; empty: the first of those of the tracker
  /// Told how many designs have been certified, of at most how many.
  std::function<void(int, int)> progress = {};
};

/// A design file with other values, or why there is none.
struct TuningResult {
  std::optional<std::string> design_text;  ///< a whole design file, TOML
  std::string reason;                      ///< one sentence when there is none
  std::vector<std::string> notes = {};     ///< sentences: what was gained
};

/// The names of the trackers that can be tuned, as a sentence lists them: "a", "a or b".
[[nodiscard]] std::string trackers_with_tuning();

[[nodiscard]] bool can_be_tuned(const Design& design);

/// What can be made best of a design of this tracker, by name.
[[nodiscard]] std::span<const std::string_view> tuning_objectives(const Design& design);

/// Chooses the free values of a design that can be tuned, for what is wanted under what is assumed, among
/// those that meet [require] as far as there are any. What the file is worth `certify` says. Throws
/// std::logic_error for another design, RequestError for an objective that the tracker does not have. Opens
/// its own rounding scopes.
[[nodiscard]] TuningResult tune(const Design& design, const TuningRequest& request);

}  // namespace veritrack::certificates
