// The sets of tubes of one name: one set, or, where the amplitude is constant and known to be in a range
// only, one for each part of that range. All samples of a signal of constant amplitude have amplitudes in one
// part. The statements on the set of a part are shown for amplitudes that may differ from sample to sample
// within the part, so they are true for this signal with the set of its part.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "checker/model/model_design.hpp"
#include "checker/model/tube_check.hpp"

namespace veritrack::checker {

/// Verified sets of one name. Each is for all frequencies that it covers, and together they are for all
/// amplitudes of the design.
struct TubeFamily {
  std::string name;
  std::vector<TubeSet> sets;  ///< at least one; of parts from low amplitudes to high ones

  /// The noise and slew that all of them tolerate.
  [[nodiscard]] double noise() const { return least(&TubeSet::noise); }
  [[nodiscard]] double slew() const { return least(&TubeSet::slew); }
  [[nodiscard]] bool is_gaussian() const { return sets.front().gaussian.has_value(); }

 private:
  [[nodiscard]] double least(double TubeSet::*size) const {
    double result = sets.front().*size;
    for (const TubeSet& set : sets) {
      result = std::min(result, set.*size);
    }
    return result;
  }
};

/// The tracker on the amplitudes of a set: those of its part, of which every sample may have another one, or
/// those of the design. Objects unless the set is for a part where the design has a constant amplitude in a
/// range, and for none otherwise.
TrackedModel on_amplitudes_of(const TubeSet& set, const TrackedModel& model, const ModelDesign& design,
                              Objections& objections);

/// Objects unless the sets are one, or have parts of amplitudes that go from low ones to high ones without
/// gaps and cover those of the design.
void check_amplitudes(const std::vector<TubeSet>& sets, const ModelDesign& design, Objections& objections);

/// Objects unless two families are for the same parts of the amplitudes, in the same order: Theorem 10 needs
/// both sets to be for one and the same part.
void check_same_parts(const std::vector<TubeSet>& sets, const std::vector<TubeSet>& others,
                      Objections& objections);

/// The statement of PhaseTubeCheck for every set.
class FamilyCheck {
 public:
  using Level = std::function<std::size_t(const PhaseTube&)>;

  FamilyCheck(const TrackedModel& model, const std::vector<TubeSet>& sets, std::int64_t& cells)
      : model_(&model), sets_(&sets), cells_(&cells) {}

  [[nodiscard]] bool error_is_below(const Level& level, const Ball& bound) const {
    return all([&](const PhaseTubeCheck& set) { return set.error_is_below(level, bound); });
  }
  [[nodiscard]] bool error_is_at_most(const Level& level, const Ball& bound) const {
    return all([&](const PhaseTubeCheck& set) { return set.error_is_at_most(level, bound); });
  }
  [[nodiscard]] bool contains_errors(const Ball& reach) const {
    return all([&](const PhaseTubeCheck& set) { return set.contains_errors(reach); });
  }
  [[nodiscard]] bool contains_starts(const std::vector<Ball>& deviations, const Ball& share = one) const {
    return all([&](const PhaseTubeCheck& set) { return set.contains_starts(deviations, share); });
  }
  [[nodiscard]] bool mean_error_is_between(const Ball& low, const Ball& high) const {
    return all([&](const PhaseTubeCheck& set) { return set.mean_error_is_between(low, high); });
  }
  [[nodiscard]] bool error_varies_by_at_most(const Ball& most) const {
    return all([&](const PhaseTubeCheck& set) { return set.error_varies_by_at_most(most); });
  }

 private:
  /// False for an empty list.
  template <typename Question>
  [[nodiscard]] bool all(const Question& holds) const {
    return !sets_->empty() && std::all_of(sets_->begin(), sets_->end(), [&](const TubeSet& set) {
      return holds(PhaseTubeCheck(*model_, set, *cells_));
    });
  }

  const TrackedModel* model_;
  const std::vector<TubeSet>* sets_;
  std::int64_t* cells_;
};

}  // namespace veritrack::checker
