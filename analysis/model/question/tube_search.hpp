// Sets of tubes for the tasks of a question: at one amplitude, or for a constant one in a range, part by
// part.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/model/set/amplitude_parts.hpp"
#include "analysis/model/set/searched_band.hpp"
#include "analysis/model/set/tube_set.hpp"
#include "analysis/model/steady_state/linear_worst_case.hpp"

namespace veritrack::model {

/// Searches for tubes over a band, which is not empty.
class TubeSearch {
 public:
  /// At the amplitudes of `tracker`. Both must outlive this.
  TubeSearch(const TrackedTone& tone, const TrackerModel& tracker, SearchedBand band,
             search::Deadline deadline);
  /// For a constant amplitude in the range of `tracker`, which is cut into parts, with tubes for each
  /// (docs/model-proof.md, section 17). `tracker` must outlive this.
  TubeSearch(const ToneAtAmplitude& tone_at, const TrackerModel& tracker, SearchedBand band,
             search::Deadline deadline);

  /// Tubes over the whole band. For a constant frequency, or one that moves, as the task states. `progress`
  /// receives the share that is done, and must not be empty.
  [[nodiscard]] TubeSet prove(const SetTask& task, const SetProgress& progress) const;
  /// Tubes of a filter in the long run, inside the set; empty unless they are proved for all amplitudes.
  [[nodiscard]] std::optional<TubeSet> prove_long_run(const TubeSet& set) const;
  /// To first order, at the worst of some frequencies of the set and of the amplitudes in the middle of the
  /// parts, each of which is constant; empty where one has no steady state.
  [[nodiscard]] std::optional<LinearWorstCase> linear_over(const TubeSet& set) const;

 private:
  [[nodiscard]] TubeSet prove_parts(const SetTask& task, const SetProgress& progress) const;
  /// On the amplitudes of a part, which may differ from sample to sample.
  [[nodiscard]] TrackerModel tracker_at(std::size_t part) const;

  const TrackerModel* tracker_;
  SearchedBand band_;
  search::Deadline deadline_;
  std::vector<AmplitudeRange> ranges_;  ///< of the parts; empty: the amplitudes of the tracker
  std::vector<TrackedTone> tones_;      ///< of the middle of each part; or the only one
};

}  // namespace veritrack::model
