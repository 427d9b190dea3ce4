#include "analysis/model/set/tube_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/model/set/level_search.hpp"
#include "analysis/model/set/set_parts.hpp"
#include "analysis/model/set/set_search.hpp"
#include "analysis/model/step/undefined_operation.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using detail::LevelSearch;
using rigor::Interval;

}  // namespace

TubeSet prove_set(const TrackedTone& tone, const TrackerModel& model, double low, double high,
                  const SetTask& task, const SetProgress& progress) {
  const rigor::NearestRounding nearest;
  TubeSet set;
  set.name = task.name;
  double noise = task.largest_noise ? INFINITY : task.noise;
  std::vector<std::pair<double, double>> noises;  // of the tube about a frequency
  FailedCells failures;
  const auto prove_cell = [&](TubeProposal& cell, bool may_be_halved) {
    const double from = cell.frequency - cell.half_width;
    const double to = cell.frequency + cell.half_width;
    bool is_good = cell.outcome == TubeOutcome::proposed;
    if (cell.outcome == TubeOutcome::proposed) {
      widen(*cell.tube);
      LevelSearch search(model, cell, task, (to - from) / (high - low));
      std::optional<ProvedTube> proved;
      if (task.largest_noise) {
        if (auto found = search.with_largest_noise(task.of_each_cell ? INFINITY : noise)) {
          noise = std::min(noise, found->second);
          proved = std::move(found->first);
          proved->own_noise = found->second;
        }
      } else {
        proved = search.with_noise(noise);
      }
      if (proved) {
        set.tubes.push_back(*std::move(proved));
        noises.emplace_back(cell.frequency, noise);
      } else if (may_be_halved && !task.deadline.is_over()) {
        return false;
      } else {
        is_good = false;
        const double known_noise = std::isfinite(noise) ? noise : 0.0;
        std::string reason = task.deadline.is_over() ? std::string(kTimeLimit)
                             : known_noise > 0.0
                                 ? fmt::format("no radius was proved for noise {:.4g}", known_noise)
                                 : std::string("no radius was proved");
        if (!task.deadline.is_over()) {
          reason += words_of_undefined(tone, model, cell, search.guess(), known_noise);
        }
        failures.add(reason, from, to);
      }
      cell.tube.reset();
    }
    if (progress) {
      progress((to - low) / (high - low));
    }
    return is_good;
  };
  BandSettings settings = settings_of(tone, task, low, high);
  settings.decided = prove_cell;
  const BandProposal band = propose_band(tone, low, high, settings);
  set.reasons = reasons_of(band);
  for (const std::string& reason : failures.reasons()) {
    set.reasons.push_back(reason);
  }
  keep_widest_part(set, low, high);
  if (set.tubes.empty()) {
    set.noise = std::isfinite(noise) ? noise : 0.0;
    return set;
  }
  // A proof for some noise is also one for less.
  set.noise = INFINITY;
  for (const auto& [frequency, proved_for] : noises) {
    const bool is_kept =
        set.tubes.front().tube.frequency <= frequency && frequency <= set.tubes.back().tube.frequency;
    set.noise = is_kept ? std::min(set.noise, proved_for) : set.noise;
  }
  return set;
}

double samples_until(const ProvedTube& proved, std::size_t level, const std::vector<double>& crossing) {
  const rigor::UpwardRounding upward;
  double samples = 0.0;
  for (std::size_t j = 0; j < level; ++j) {
    const Interval ratio = Interval(proved.levels[j + 1]) / Interval(proved.levels[j]);
    const double factor = crossing.empty() ? proved.shrinking[j] : std::max(proved.shrinking[j], crossing[j]);
    const Interval count = log(ratio) / log(Interval(factor));
    samples += rigor::is_finite(count) ? std::ceil(count.upper()) : INFINITY;
  }
  return samples;
}

double samples_until_long_run(const ProvedTube& around, const ProvedTube& inner, std::size_t level) {
  const rigor::UpwardRounding upward;
  const double entered = inner.entry ? inner.entry->samples() : INFINITY;
  return samples_until(around, around.levels.size() - 1) + entered + samples_until(inner, level);
}

}  // namespace veritrack::model
