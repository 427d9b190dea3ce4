#include "analysis/model/moving_frequency/moving_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "analysis/model/moving_frequency/moving_search.hpp"
#include "analysis/model/set/set_parts.hpp"
#include "analysis/model/set/set_search.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

using detail::MovingSearch;

/// Cells with a tube, without gaps: numbers from `first` up to, but not including, `end`.
struct CellRun {
  std::size_t first = 0;
  std::size_t end = 0;
};

/// The widest of the parts into which cells that are not `usable` divide a run; tubes of one part turn alike.
CellRun widest_part(const std::vector<TubeProposal>& cells, CellRun run,
                    const std::function<bool(std::size_t)>& usable) {
  CellRun best;
  double best_width = 0.0;
  CellRun part{run.first, run.first};
  double width = 0.0;
  for (std::size_t i = run.first; i < run.end; ++i) {
    const bool goes_on =
        part.end > part.first && cells[i].steady_state.turns == cells[part.first].steady_state.turns;
    if (!usable(i) || !goes_on) {
      part = {i, i};
      width = 0.0;
    }
    if (!usable(i)) {
      continue;
    }
    part.end = i + 1;
    width += 2.0 * cells[i].half_width;
    if (width > best_width) {
      best = part;
      best_width = width;
    }
  }
  return best;
}

}  // namespace

TubeSet prove_moving_set(const TrackedTone& tone, const TrackerModel& model, double low, double high,
                         const SetTask& task, const SetProgress& progress) {
  const rigor::NearestRounding nearest;
  BandSettings settings = settings_of(tone, task, low, high);
  settings.one_shape = true;
  double most = 0.0;
  const auto report = [&](double share) {
    most = std::max(most, share);
    if (progress) {
      progress(most);
    }
  };
  constexpr double kOfProposals = 0.5;  // of the time, about
  settings.decided = [&](const TubeProposal& cell, bool /*may_be_halved*/) {
    report(kOfProposals * (cell.frequency + cell.half_width - low) / (high - low));
    return true;
  };
  const BandProposal band = propose_band(tone, low, high, settings);
  TubeSet set;
  set.name = task.name;
  set.noise = task.noise;
  set.slew = task.slew;
  set.reasons = reasons_of(band);
  CellRun run = widest_part(band.cells, {0, band.cells.size()},
                            [&](std::size_t i) { return band.cells[i].outcome == TubeOutcome::proposed; });
  bool is_found = false;
  constexpr int kMostTries = 4;
  for (int tries = 0; tries < kMostTries && !is_found && run.end > run.first; ++tries) {
    set.tubes.clear();
    MovingSearch search(model, std::span(band.cells).subspan(run.first, run.end - run.first), task.deadline,
                        set, [&](double share) { report(kOfProposals + 0.4 * share); });
    is_found = task.largest_slew ? search.find_slew(task.known_slew) : search.find_levels();
    if (is_found && task.largest_slew && task.of_each_cell) {
      search.find_own_slews();
    }
    if (is_found || task.largest_slew || task.deadline.is_over()) {
      break;
    }
    // Without the cells in which it failed.
    const CellRun whole = run;
    const std::vector<std::size_t>& failed = search.failed();
    run = widest_part(band.cells, whole, [&](std::size_t i) {
      return std::find(failed.begin(), failed.end(), i - whole.first) == failed.end();
    });
    if (run.end - run.first == whole.end - whole.first) {
      break;
    }
  }
  if (!is_found) {
    set.tubes.clear();
  }
  keep_widest_part(set, low, high);
  if (!set.is_complete && (band.is_complete || !is_found)) {
    const std::string place =
        is_found ? fmt::format(" below {:.6g} and above {:.6g} rad/sample", set.part.low, set.part.high)
                 : std::string();
    set.reasons.push_back(
        task.deadline.has_struck() ? std::string(kTimeLimit)
        : task.largest_slew
            ? "no slew was proved"
            : fmt::format("no radius was proved for noise {:.4g} and slew {:.4g} rad/sample per sample{}",
                          task.noise, task.slew, place));
  }
  report(1.0);
  return set;
}

}  // namespace veritrack::model
