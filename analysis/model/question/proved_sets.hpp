// The answer to a question: the sets that are proved for a tracker.
#pragma once

#include <optional>
#include <vector>

#include "analysis/model/question/set_question.hpp"
#include "analysis/model/set/proved_set.hpp"
#include "analysis/model/steady_state/linear_worst_case.hpp"

namespace veritrack::model {

/// The requested sets, and the reasons for those that were not proved.
struct ProvedSets {
  ProvedSet starts;                    ///< without noise
  std::optional<ProvedSet> assumed;    ///< for the assumed noise and slew; none when both are 0
  std::optional<ProvedSet> long_run;   ///< of a filter: inside the lowest levels of `assumed`
  std::optional<ProvedSet> slew;       ///< for the largest slew, without noise
  std::optional<ProvedSet> noise;      ///< for the largest noise
  std::vector<FrequencySlice> slices;  ///< of `starts`
  /// The frequency error in the long run of `assumed` to first order, not proved; none where it is unknown.
  std::optional<LinearWorstCase> linear;

  /// The set for what is assumed.
  [[nodiscard]] const ProvedSet& deciding() const { return assumed ? *assumed : starts; }
};

/// Searches and verifies. The search stops at the deadline; results proved by then are kept. `progress`
/// receives the share of the tasks that is done. Deterministic up to the deadline. Holds upward rounding.
[[nodiscard]] ProvedSets prove_sets(const SetQuestion& question, const SetProgress& progress = {});

/// The proved bound of the frequency error in the long run of `assumed`, rad/sample; infinity where nothing
/// is known.
[[nodiscard]] double settled_error_of(const ProvedSets& sets);

}  // namespace veritrack::model
