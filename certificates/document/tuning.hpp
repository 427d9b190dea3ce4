// Free design values, chosen for the best guarantee.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/search/deadline.hpp"
#include "certificates/design/design.hpp"

namespace veritrack::certificates {

/// What is wanted of the tuned design.
struct TuningRequest {
  std::string design_text;     ///< the file, whose words and order are kept where that is possible
  std::string objective;       ///< one of `tuning_objectives`; empty: the first that fits what is assumed
  int most_designs = 60;       ///< that the search looks at; the trade-off and what would do instead are more
  bool free_leak = false;      ///< a leak above 0 may change, and become 0
  bool with_trade_off = true;  ///< looks at faster and slower designs, too
  search::Deadline deadline = {};  ///< the best so far is the result when it is over
  /// Told how many designs have been looked at, of at most how many.
  std::function<void(int, int)> progress = {};
};

/// A design that a search has looked at.
struct TriedDesign {
  /// What for: in the search, as it was given, as the result, or to draw the trade-off.
  enum class Role { tried, given, chosen, trade_off };
  Role role = Role::tried;
  std::vector<std::pair<std::string, std::string>> values;  ///< keys of [design] and decimals
  std::optional<double> value;                              ///< of the objective; none: nothing is known
  bool meets = false;           ///< all that is required, and covers what is assumed
  std::optional<int> response;  ///< samples until a step of the frequency is followed to within a tenth
};

/// What was looked at, for a figure: the objective against the response.
struct TradeOff {
  std::string words;           ///< what the objective is, "the certified bound ..."
  std::string unit;            ///< of the values
  bool is_to_be_small = true;  ///< the less the better
  bool is_estimated = false;   ///< values guide the search and are neither certified nor simulated
  bool is_simulated = false;
  std::optional<double> required;  ///< a limit on the value that [require] sets
  std::vector<TriedDesign> designs;
};

/// A design file with other values, or why there is none.
struct TuningResult {
  std::optional<std::string> design_text;  ///< a whole design file, TOML
  std::string reason;                      ///< one sentence when there is none
  std::vector<std::string> notes = {};     ///< sentences: what was gained
  /// Sentences: what would have to change for everything required to be met; none when it is.
  std::vector<std::string> changes = {};
  std::optional<TradeOff> trade_off = {};
};

/// The names of the trackers that can be tuned, as a sentence lists them: "a", "a or b".
[[nodiscard]] std::string trackers_with_tuning();

[[nodiscard]] bool can_be_tuned(const Design& design);

/// What can be made best of a design of this tracker, by name.
[[nodiscard]] std::span<const std::string_view> tuning_objectives(const Design& design);

/// Chooses the free values of a design that can be tuned, for what is wanted under what is assumed, among
/// those that meet [require] as far as there are any. What the file is worth `certify` says. Throws
/// std::logic_error for another design, RequestError for an objective that the tracker does not have or that
/// does not fit what is assumed. Opens its own rounding scopes.
[[nodiscard]] TuningResult tune(const Design& design, const TuningRequest& request);

}  // namespace veritrack::certificates
