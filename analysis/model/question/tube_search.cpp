#include "analysis/model/question/tube_search.hpp"

#include <fmt/format.h>

#include <utility>

#include "analysis/model/moving_frequency/moving_set.hpp"

namespace veritrack::model {

namespace {

TubeSet prove_at(const TrackedTone& tone, const TrackerModel& tracker, const SearchedBand& band,
                 const SetTask& task, const SetProgress& progress) {
  const bool moves = task.slew > 0.0 || task.largest_slew;
  return moves ? prove_moving_set(tone, tracker, band.low, band.high, task, progress)
               : prove_set(tone, tracker, band.low, band.high, task, progress);
}

std::optional<LinearWorstCase> worse(const std::optional<LinearWorstCase>& a,
                                     const std::optional<LinearWorstCase>& b) {
  return !a || b->disturbed > a->disturbed ? b : a;
}

std::optional<LinearWorstCase> linear_at(const TrackedTone& tone, const TubeSet& set) {
  constexpr int kFrequencies = 5;
  std::optional<LinearWorstCase> worst;
  for (int i = 0; i < kFrequencies; ++i) {
    const double share = static_cast<double>(i) / (kFrequencies - 1);
    const double frequency = set.part.low + share * (set.part.high - set.part.low);
    const auto here = linear_worst_case(tone, frequency, set.noise, set.slew);
    if (!here) {
      return std::nullopt;
    }
    worst = worse(worst, here);
  }
  return worst;
}

}  // namespace

TubeSearch::TubeSearch(const TrackedTone& tone, const TrackerModel& tracker, SearchedBand band,
                       search::Deadline deadline)
    : tracker_(&tracker), band_(std::move(band)), deadline_(std::move(deadline)), tones_{tone} {}

TubeSearch::TubeSearch(const ToneAtAmplitude& tone_at, const TrackerModel& tracker, SearchedBand band,
                       search::Deadline deadline)
    : tracker_(&tracker), band_(std::move(band)), deadline_(std::move(deadline)) {
  const std::size_t count = parts_of_range(tone_at, tracker.amplitude, band_.low, band_.high, deadline_);
  ranges_ = equal_parts(tracker.amplitude, count);
  for (const auto& [low, high] : ranges_) {
    tones_.push_back(tone_at(low + 0.5 * (high - low), 0.5 * (high - low)));
  }
}

TubeSet TubeSearch::prove(const SetTask& task, const SetProgress& progress) const {
  TubeSet tubes = ranges_.empty() ? prove_at(tones_.front(), *tracker_, band_, task, progress)
                                  : prove_parts(task, progress);
  tubes.is_complete = tubes.is_complete && band_.out_of_reach.empty();
  tubes.reasons.insert(tubes.reasons.begin(), band_.out_of_reach.begin(), band_.out_of_reach.end());
  return tubes;
}

TubeSet TubeSearch::prove_parts(const SetTask& task, const SetProgress& progress) const {
  std::vector<TubeSet> sets;
  for (std::size_t k = 0; k < ranges_.size(); ++k) {
    const auto tell = [&](double share) {
      progress((static_cast<double>(k) + share) / static_cast<double>(ranges_.size()));
    };
    TubeSet set = prove_at(tones_[k], tracker_at(k), band_, task, tell);
    // A shape that was not made for disturbances may have no room for the amplitudes.
    const bool has_other = task.objective != ShapeObjective::largest_noise;
    if (!set.is_complete && has_other && !deadline_.is_over()) {
      SetTask for_noise = task;
      for_noise.objective = ShapeObjective::largest_noise;
      TubeSet other = prove_at(tones_[k], tracker_at(k), band_, for_noise, {});
      if (other.is_complete) {
        set = std::move(other);
      }
    }
    sets.push_back(std::move(set));
  }
  TubeSet all = join_amplitudes(std::move(sets), ranges_);
  if (!all.is_complete && ranges_.size() == kMostAmplitudeParts) {
    all.reasons.push_back(
        fmt::format("the range of amplitudes is cut into {} parts, which are the most that are tried: for a "
                    "narrower range they would be narrower",
                    ranges_.size()));
  }
  return all;
}

std::optional<TubeSet> TubeSearch::prove_long_run(const TubeSet& set) const {
  if (ranges_.empty()) {
    return prove_long_run_set(tones_.front(), *tracker_, set, deadline_);
  }
  std::vector<TubeSet> inner;
  const std::vector<TubeSet> around = sets_of_amplitudes(set);
  for (std::size_t k = 0; k < ranges_.size() && around.size() == ranges_.size(); ++k) {
    auto tubes = prove_long_run_set(tones_[k], tracker_at(k), around[k], deadline_);
    if (!tubes) {
      return std::nullopt;
    }
    inner.push_back(*std::move(tubes));
  }
  return inner.empty() ? std::nullopt : std::optional(join_amplitudes(std::move(inner), ranges_));
}

std::optional<LinearWorstCase> TubeSearch::linear_over(const TubeSet& set) const {
  if (ranges_.empty()) {
    return linear_at(tones_.front(), set);
  }
  std::optional<LinearWorstCase> worst;
  for (const TrackedTone& tone : tones_) {
    TrackedTone constant = tone;
    constant.amplitude_deviation = 0.0;
    const auto here = linear_at(constant, set);
    if (!here) {
      return std::nullopt;
    }
    worst = worse(worst, here);
  }
  return worst;
}

TrackerModel TubeSearch::tracker_at(std::size_t part) const {
  TrackerModel tracker = *tracker_;
  tracker.amplitude = rigor::Interval::from_bounds(ranges_[part].low, ranges_[part].high);
  tracker.amplitude_varies = true;
  return tracker;
}

}  // namespace veritrack::model
