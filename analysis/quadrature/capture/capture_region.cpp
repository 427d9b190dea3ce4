#include "analysis/quadrature/capture/capture_region.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;

struct OpenCell {
  StartBox starts;
  int halvings = 0;
  double share = 1.0;  ///< of the volume of all starts
};

Interval& side(StartBox& box, int direction) {
  return direction == 0 ? box.amplitude_error : direction == 1 ? box.phase_error : box.frequency_error;
}

/// The parts of an interval, which share their ends; one part when there is nothing to cut.
std::vector<Interval> parts(const Interval& whole, int count) {
  std::vector<double> ends = {whole.lower()};
  const double length = whole.upper() - whole.lower();
  for (int i = 1; i < count; ++i) {
    const double end = whole.lower() + length * (static_cast<double>(i) / static_cast<double>(count));
    if (end > ends.back() && end < whole.upper()) {
      ends.push_back(end);
    }
  }
  ends.push_back(whole.upper());
  std::vector<Interval> result;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    result.push_back(Interval::from_bounds(ends[i - 1], ends[i]));
  }
  return result;
}

std::vector<OpenCell> first_cells(const StartBox& starts, const RegionOptions& options) {
  std::vector<OpenCell> cells;
  for (const Interval& amplitude : parts(starts.amplitude_error, options.first_cells[0])) {
    for (const Interval& phase : parts(starts.phase_error, options.first_cells[1])) {
      for (const Interval& frequency : parts(starts.frequency_error, options.first_cells[2])) {
        cells.push_back({{amplitude, phase, frequency}, 0, 1.0});
      }
    }
  }
  for (OpenCell& cell : cells) {
    cell.share = 1.0 / static_cast<double>(cells.size());
  }
  return cells;
}

/// Two halves along the direction; none when it has no interior double to cut at.
std::vector<OpenCell> halves(const OpenCell& cell, int direction) {
  OpenCell lower = cell;
  OpenCell upper = cell;
  const Interval whole = side(lower.starts, direction);
  const double cut = midpoint(whole);
  if (!(whole.lower() < cut && cut < whole.upper())) {
    return {};
  }
  side(lower.starts, direction) = Interval::from_bounds(whole.lower(), cut);
  side(upper.starts, direction) = Interval::from_bounds(cut, whole.upper());
  ++lower.halvings;
  ++upper.halvings;
  lower.share *= 0.5;
  upper.share *= 0.5;
  return {lower, upper};
}

Verdict verdict_of(const CaptureResult& result) {
  switch (result.outcome) {
    case CaptureOutcome::locked:
      return Verdict::proved;
    case CaptureOutcome::locked_elsewhere:
      return Verdict::refuted;
    default:
      return Verdict::undecided;
  }
}

/// The cell, followed. A cell that will not be halved again is given a last chance to be refuted by its
/// middle.
RegionCell followed(const CaptureProblem& problem, const CaptureTarget& target, const OpenCell& cell,
                    const RegionOptions& options) {
  RegionCell done;
  done.starts = cell.starts;
  done.result = follow_starts(problem, target, cell.starts);
  done.verdict = verdict_of(done.result);
  if (done.verdict == Verdict::undecided && cell.halvings >= options.most_halvings) {
    const CaptureResult witness = follow_starts(problem, target, middle(cell.starts));
    if (verdict_of(witness) == Verdict::refuted) {
      done.verdict = Verdict::refuted;
      done.result = witness;
      done.whole = false;
    }
  }
  return done;
}

void require_sensible(const StartBox& starts, const RegionOptions& options) {
  const bool finite =
      is_finite(starts.amplitude_error) && is_finite(starts.phase_error) && is_finite(starts.frequency_error);
  const bool positive = *std::min_element(options.first_cells.begin(), options.first_cells.end()) > 0 &&
                        options.most_halvings >= 0 && options.generation_size > 0;
  if (!finite || !positive) {
    throw std::invalid_argument("region of attraction: the starts must be finite and the numbers positive");
  }
}

/// Takes the bounds of a captured cell into those of the region.
void add_frequency_errors(std::vector<double>& all, const std::vector<double>& cell) {
  all.resize(std::max(all.size(), cell.size()), 0.0);
  for (std::size_t k = 0; k < cell.size(); ++k) {
    all[k] = std::max(all[k], cell[k]);
  }
}

}  // namespace

StartBox middle(const StartBox& box) {
  return {Interval(midpoint(box.amplitude_error)), Interval(midpoint(box.phase_error)),
          Interval(midpoint(box.frequency_error))};
}

Region prove_region(const CaptureProblem& problem, const CaptureTarget& target, const StartBox& starts,
                    const RegionOptions& options,
                    const std::function<bool(const RegionProgress&)>& progress) {
  require_sensible(starts, options);
  Region region;
  RegionProgress so_far;
  // A queue, first in, first out: the coarse cells of the whole region come before the fine ones of a part.
  std::vector<OpenCell> open = first_cells(starts, options);
  bool stopped = false;
  while (!open.empty() && !stopped) {
    const std::size_t allowed = options.most_cells - std::min(options.most_cells, region.propagations);
    const std::size_t count = std::min({open.size(), options.generation_size, allowed});
    if (count == 0) {
      break;
    }
    std::vector<RegionCell> done(count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t i = range.begin(); i < range.end(); ++i) {
                          done[i] = followed(problem, target, open[i], options);
                        }
                      });
    std::vector<OpenCell> next(open.begin() + static_cast<std::ptrdiff_t>(count), open.end());
    for (std::size_t i = 0; i < count; ++i) {
      ++region.propagations;
      region.samples += static_cast<std::size_t>(done[i].result.samples);
      if (done[i].verdict == Verdict::undecided && open[i].halvings < options.most_halvings) {
        const auto cut = halves(open[i], done[i].result.widest_direction);
        if (!cut.empty()) {
          next.insert(next.end(), cut.begin(), cut.end());
          continue;
        }
      }
      double& share = done[i].verdict == Verdict::proved    ? so_far.proved_share
                      : done[i].verdict == Verdict::refuted ? so_far.refuted_share
                                                            : so_far.undecided_share;
      share += open[i].share;
      if (done[i].verdict == Verdict::proved) {
        add_frequency_errors(region.frequency_errors, done[i].result.frequency_errors);
      }
      // For many thousand cells these would take too much memory.
      done[i].result.frequency_errors.clear();
      done[i].result.frequency_errors.shrink_to_fit();
      region.cells.push_back(done[i]);
    }
    open = std::move(next);
    so_far.propagations = region.propagations;
    stopped = progress && !progress(so_far);
  }
  region.unfinished = stopped ? open.size() : 0;
  for (const OpenCell& cell : open) {
    RegionCell left;
    left.starts = cell.starts;
    region.cells.push_back(left);
  }
  return region;
}

Verdict verdict(const Region& region) noexcept {
  std::vector<Verdict> verdicts;
  for (const RegionCell& cell : region.cells) {
    verdicts.push_back(cell.verdict);
  }
  return rigor::conjunction(verdicts);
}

}  // namespace veritrack::quadrature
