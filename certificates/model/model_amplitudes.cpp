#include "certificates/model/model_amplitudes.hpp"

#include <fmt/format.h>

#include <utility>

#include "analysis/model/moving_frequency/moving_set.hpp"

namespace veritrack::certificates {

using model::TubeSet;

TubeSet prove_task(const model::TrackedTone& tone, const model::TrackerModel& tracker,
                   const SearchedBand& band, const model::SetTask& task, const model::SetProgress& progress) {
  const bool moves = task.slew > 0.0 || task.largest_slew;
  return moves ? model::prove_moving_set(tone, tracker, band.low, band.high, task, progress)
               : model::prove_set(tone, tracker, band.low, band.high, task, progress);
}

std::optional<model::LinearWorstCase> linear_over(const model::TrackedTone& tone, const TubeSet& set) {
  constexpr int kFrequencies = 5;
  std::optional<model::LinearWorstCase> worst;
  for (int i = 0; i < kFrequencies; ++i) {
    const double share = static_cast<double>(i) / (kFrequencies - 1);
    const double frequency = set.part.low + share * (set.part.high - set.part.low);
    const auto here = linear_worst_case(tone, frequency, set.noise, set.slew);
    if (!here) {
      return std::nullopt;
    }
    worst = !worst || here->disturbed > worst->disturbed ? here : worst;
  }
  return worst;
}

AmplitudeParts::AmplitudeParts(const Model& model, const model::TrackerModel& tracker,
                               const trackers::FilterParts* filter, const SearchedBand& band,
                               const search::Deadline& deadline)
    : tracker_(&tracker), band_(&band), deadline_(deadline) {
  const auto tone_at = [&](double amplitude, double deviation) {
    model::TrackedTone tone = proposed_tone(model, amplitude, deviation);
    tone.filter = filter;
    return tone;
  };
  const std::size_t count = model::parts_of_range(tone_at, tracker.amplitude, band.low, band.high, deadline);
  ranges_ = model::equal_parts(tracker.amplitude, count);
  for (const auto& [low, high] : ranges_) {
    tones_.push_back(tone_at(low + 0.5 * (high - low), 0.5 * (high - low)));
  }
}

TubeSet AmplitudeParts::prove(const model::SetTask& task, const model::SetProgress& progress) const {
  std::vector<TubeSet> sets;
  for (std::size_t k = 0; k < ranges_.size(); ++k) {
    const auto tell = [&](double share) {
      progress((static_cast<double>(k) + share) / static_cast<double>(ranges_.size()));
    };
    TubeSet set = prove_task(tones_[k], tracker_at(k), *band_, task, tell);
    // A shape that was not made for disturbances may have no room for the amplitudes.
    const bool has_other = task.objective != model::ShapeObjective::largest_noise;
    if (!set.is_complete && has_other && !deadline_.is_over()) {
      model::SetTask for_noise = task;
      for_noise.objective = model::ShapeObjective::largest_noise;
      TubeSet other = prove_task(tones_[k], tracker_at(k), *band_, for_noise, {});
      if (other.is_complete) {
        set = std::move(other);
      }
    }
    sets.push_back(std::move(set));
  }
  TubeSet all = model::join_amplitudes(std::move(sets), ranges_);
  if (!all.is_complete && ranges_.size() == model::kMostAmplitudeParts) {
    all.reasons.push_back(
        fmt::format("the range of amplitudes is cut into {} parts, which are the most that are tried: for a "
                    "narrower range "
                    "they would be narrower",
                    ranges_.size()));
  }
  return all;
}

std::optional<TubeSet> AmplitudeParts::prove_long_run(const TubeSet& set) const {
  std::vector<TubeSet> inner;
  const std::vector<TubeSet> around = model::sets_of_amplitudes(set);
  for (std::size_t k = 0; k < ranges_.size() && around.size() == ranges_.size(); ++k) {
    auto tubes = model::prove_long_run_set(tones_[k], tracker_at(k), around[k], deadline_);
    if (!tubes) {
      return std::nullopt;
    }
    inner.push_back(*std::move(tubes));
  }
  return inner.empty() ? std::nullopt : std::optional(model::join_amplitudes(std::move(inner), ranges_));
}

std::optional<model::LinearWorstCase> AmplitudeParts::linear_over(const TubeSet& set) const {
  std::optional<model::LinearWorstCase> worst;
  for (const model::TrackedTone& tone : tones_) {
    model::TrackedTone constant = tone;
    constant.amplitude_deviation = 0.0;
    const auto here = certificates::linear_over(constant, set);
    if (!here) {
      return std::nullopt;
    }
    worst = !worst || here->disturbed > worst->disturbed ? here : worst;
  }
  return worst;
}

model::TrackerModel AmplitudeParts::tracker_at(std::size_t part) const {
  model::TrackerModel tracker = *tracker_;
  tracker.amplitude = rigor::Interval::from_bounds(ranges_[part].low, ranges_[part].high);
  tracker.amplitude_varies = true;
  return tracker;
}

}  // namespace veritrack::certificates
