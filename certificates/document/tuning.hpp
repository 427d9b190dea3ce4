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

/// A parameter that may change, from `low` to `high`, which is larger.
struct FreeParameter {
  std::string name;
  double low = 0.0, high = 0.0;
};

/// The parameter of "NAME=LOW:HIGH" with two decimals. Empty for other words.
[[nodiscard]] std::optional<FreeParameter> free_parameter(std::string_view words);

/// The request for a tuned design.
struct TuningRequest {
  std::string design_text;  ///< the file, whose words and order are kept where that is possible
  std::string objective;    ///< one of `tuning_objectives`; empty: the first that fits the assumptions
  int most_designs = 60;    ///< in the search; the trade-off and the alternatives are extra
  std::vector<FreeParameter> over = {};  ///< for trackers whose parameters the user has named
  bool free_leak = false;                ///< a leak above 0 may change, and become 0
  bool with_trade_off = true;            ///< also examines faster and slower designs
  search::Deadline deadline = {};        ///< the best so far is the result when it is over
  /// Called with the number of designs examined, and the most there may be.
  std::function<void(int, int)> progress = {};
};

/// A design that a search has examined.
struct TriedDesign {
  /// Its purpose: in the search, as it was given, as the result, or to draw the trade-off.
  enum class Role { tried, given, chosen, trade_off };
  Role role = Role::tried;
  std::vector<std::pair<std::string, std::string>> values;  ///< keys of [design] and decimals
  std::optional<double> value;                              ///< of the objective; none: nothing is known
  bool meets = false;                                       ///< all requirements, and covers the assumptions
  std::optional<int> response;  ///< samples until a step of the frequency is followed to within a tenth
};

/// The examined designs, for a figure: the objective against the response.
struct TradeOff {
  std::string words;           ///< the words for the objective, "the certified bound ..."
  std::string unit;            ///< of the values
  bool is_to_be_small = true;  ///< the less the better
  bool is_estimated = false;   ///< values guide the search and are neither certified nor simulated
  bool is_simulated = false;
  std::optional<double> required;  ///< a limit on the value that [require] sets
  std::vector<TriedDesign> designs;
};

/// A design file with other values, or the reason why there is none.
struct TuningResult {
  std::optional<std::string> design_text;  ///< a whole design file, TOML
  std::string reason;                      ///< one sentence when there is none
  std::vector<std::string> notes = {};     ///< sentences: the gain
  /// Sentences: the changes needed to meet all requirements; empty when all are met.
  std::vector<std::string> changes = {};
  std::optional<TradeOff> trade_off = {};
};

/// The names of the trackers that can be tuned, as a sentence lists them: "a", "a or b".
[[nodiscard]] std::string trackers_with_tuning();

[[nodiscard]] bool can_be_tuned(const Design& design);

/// The objectives for a design of this tracker, by name.
[[nodiscard]] std::span<const std::string_view> tuning_objectives(const Design& design);

/// Chooses the free values of a design that can be tuned, for the requested objective under the assumptions,
/// among those that meet [require] as far as there are any. `certify` then evaluates the file. Throws
/// std::logic_error for another design, RequestError for an objective that the tracker does not have or that
/// does not fit the assumptions. Opens its own rounding scopes.
[[nodiscard]] TuningResult tune(const Design& design, const TuningRequest& request);

}  // namespace veritrack::certificates
