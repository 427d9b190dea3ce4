// Sets of tubes of a model: at its amplitude, or of a constant amplitude in a range, part by part.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/model/set/amplitude_parts.hpp"
#include "analysis/model/steady_state/linear_worst_case.hpp"
#include "certificates/model/model_sets.hpp"

namespace veritrack::certificates {

/// For a constant frequency, or one that moves: what the task says.
[[nodiscard]] model::TubeSet prove_task(const model::TrackedTone& tone, const model::TrackerModel& tracker,
                                        const SearchedBand& band, const model::SetTask& task,
                                        const model::SetProgress& progress);

/// To first order, at the worst of some frequencies of a set; nothing where one has no steady state.
[[nodiscard]] std::optional<model::LinearWorstCase> linear_over(const model::TrackedTone& tone,
                                                                const model::TubeSet& set);

/// A constant amplitude in a range: parts of the range, with tubes for each (docs/model-proof.md, section
/// 17).
class AmplitudeParts {
 public:
  /// `tracker`: on the amplitudes of the range. `filter`: of which the covariance is to be bounded, or none.
  /// All must outlive this.
  AmplitudeParts(const Model& model, const model::TrackerModel& tracker, const trackers::FilterParts* filter,
                 const SearchedBand& band, const search::Deadline& deadline);

  /// Told the share of all parts.
  [[nodiscard]] model::TubeSet prove(const model::SetTask& task, const model::SetProgress& progress) const;
  /// Inside the set; nothing unless it is proved for all parts.
  [[nodiscard]] std::optional<model::TubeSet> prove_long_run(const model::TubeSet& set) const;
  /// To first order, at the worst of the amplitudes in the middle of the parts: each of them is constant.
  [[nodiscard]] std::optional<model::LinearWorstCase> linear_over(const model::TubeSet& set) const;

 private:
  /// On the amplitudes of a part, which may differ from sample to sample.
  [[nodiscard]] model::TrackerModel tracker_at(std::size_t part) const;

  const model::TrackerModel* tracker_;
  const SearchedBand* band_;
  search::Deadline deadline_;
  std::vector<model::AmplitudeRange> ranges_;
  std::vector<model::TrackedTone> tones_;  ///< of the middle of each part
};

}  // namespace veritrack::certificates
