#include "analysis/quadrature/gaussian/lock_verification.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;

bool certainly_definite(const LevelCovariance<double>& p) {
  return rigor::is_positive_definite(enclosed(p)) == Verdict::proved;
}
bool is_apart(const LevelCovariance<double>& p) {
  return p.p12 == 0.0 && p.p13 == 0.0;
}

/// The first hypothesis on the inputs that does not hold, as a sentence; empty when all hold.
std::string objection(const trackers::ToneModel<Interval>& design, const LockSet& set) {
  if (!certainly_positive(design.r) || !certainly_positive(design.q2) || !certainly_not_negative(design.q1)) {
    return "the design is not one with q1 >= 0, q2 > 0 and r > 0.";
  }
  if (!certainly_not_negative(design.epsilon) || !certainly_less(design.epsilon, Interval(1.0))) {
    return "the leak is not one with 0 <= epsilon < 1.";
  }
  if (!(set.lowest_frequency <= set.highest_frequency) || !std::isfinite(set.lowest_frequency) ||
      !std::isfinite(set.highest_frequency) || !std::isfinite(set.bias[0]) || !std::isfinite(set.bias[1]) ||
      !std::isfinite(set.bias[2])) {
    return "the frequencies or the errors about which the set lies are outside their ranges.";
  }
  if (!certainly_positive(Interval(set.metric.amplitude)) ||
      !certainly_positive(Interval(set.metric.phase)) ||
      !certainly_positive(Interval(set.metric.frequency)) || !is_finite(Interval(set.metric.coupling))) {
    return "the metric is not certainly invertible.";
  }
  if (!certainly_definite(set.centre) || !certainly_definite(set.spread_above) ||
      !certainly_definite(set.spread_below)) {
    return "the covariances of the levels are not certainly positive definite.";
  }
  if (!certainly_positive(Interval(set.weight)) || !certainly_positive(Interval(set.level)) ||
      !certainly_not_negative(Interval(set.drift)) || !certainly_positive(Interval(set.noise_deviation)) ||
      !certainly_not_negative(Interval(set.frequency_walk))) {
    return "the weight, the level, the drift or the noise are outside their ranges.";
  }
  const Interval walked =
      rigor::square(Interval(set.frequency_walk)) *
      (rigor::square(Interval(set.metric.coupling)) + rigor::square(Interval(set.metric.frequency)));
  if (!certainly_less(walked, Interval(1.0))) {
    return "the frequency walks too far in a sample for this metric.";
  }
  return {};
}

/// Bisects a cell until the inequality is proved on all parts.
struct Walk {
  const DriftInequality& inequality;
  std::int64_t most_cells;
  std::int64_t cells = 0;

  bool proves(const LevelCell& cell, int depth) {
    if (inequality.outside(cell)) {
      return true;
    }
    if (++cells > most_cells) {
      return false;
    }
    const CellDrift found = inequality.check(cell);
    if (found.holds) {
      return true;
    }
    if (depth == 0) {
      return false;
    }
    const auto side = static_cast<std::size_t>(std::distance(
        found.influence.begin(), std::max_element(found.influence.begin(), found.influence.end())));
    LevelCell first = cell;
    LevelCell second = cell;
    first.high[side] = second.low[side] = 0.5 * (cell.low[side] + cell.high[side]);
    return proves(first, depth - 1) && proves(second, depth - 1);
  }
};

/// True only when the mirror image (e2, nu, P12, P13, v2, w) -> -(...) commutes with the step and maps the
/// set to itself.
bool has_mirror_image(const trackers::ToneModel<Interval>& design, const LockSet& set) {
  return design.epsilon == Interval(0.0) && set.bias[1] == 0.0 && set.bias[2] == 0.0 &&
         is_apart(set.centre) && is_apart(set.spread_above) && is_apart(set.spread_below);
}

/// A grid over (u1, u2, u3, s); where the mirror image covers the other half, with u3 >= 0.
std::vector<LevelCell> grid_of(const LockSet& set, bool half) {
  const std::array<int, 4> parts{8, 8, half ? 4 : 8, 6};
  // A hair more than enough.
  const double radius = 1.000001 * std::sqrt(2.0 * set.level);
  const std::array<double, 4> low{-radius, -radius, half ? 0.0 : -radius, 0.0};
  const std::array<double, 4> high{radius, radius, radius, radius / std::sqrt(set.weight)};
  std::vector<LevelCell> cells{{}};
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<LevelCell> next;
    const auto node = [&](int k) { return low[i] + (high[i] - low[i]) * k / parts[i]; };
    next.reserve(cells.size() * static_cast<std::size_t>(parts[i]));
    for (const LevelCell& cell : cells) {
      for (int k = 0; k < parts[i]; ++k) {
        LevelCell part = cell;
        part.low[i] = node(k);
        part.high[i] = node(k + 1);
        next.push_back(part);
      }
    }
    cells = std::move(next);
  }
  return cells;
}

/// True only when every point with a level of at most that of the set has its |u_i| and s within the grid.
bool covers_set(const std::vector<LevelCell>& grid, const LockSet& set, bool half) {
  const Interval most = Interval(2.0) * Interval(set.level);
  const LevelCell& last = grid.back();
  for (std::size_t i = 0; i < 4; ++i) {
    const Interval weight = i == 3 ? Interval(set.weight) : Interval(1.0);
    if (!certainly_less_equal(most, weight * rigor::square(Interval(last.high[i])))) {
      return false;
    }
  }
  return grid.front().low[0] == -last.high[0] && grid.front().low[1] == -last.high[1] &&
         grid.front().low[2] == (half ? 0.0 : -last.high[2]) && grid.front().low[3] == 0.0;
}

}  // namespace

LockVerification verify_lock_set(const trackers::ToneModel<Interval>& design, const LockSet& proposal,
                                 std::int64_t most_cells) {
  const rigor::UpwardRounding upward;
  LockVerification result;
  result.reason = objection(design, proposal);
  if (!result.reason.empty()) {
    return result;
  }
  constexpr int kDepth = 40;
  const bool half = has_mirror_image(design, proposal);
  const std::vector<LevelCell> grid = grid_of(proposal, half);
  if (!covers_set(grid, proposal, half)) {
    result.reason = "the numbers are too large to be covered by cells.";
    return result;
  }
  const DriftInequality inequality(design, proposal);
  std::vector<std::int64_t> cells(grid.size(), 0);
  std::atomic<bool> failed = false;
  tbb::parallel_for(std::size_t{0}, grid.size(), [&](std::size_t k) {
    if (failed) {
      return;
    }
    const rigor::UpwardRounding upward_here;
    Walk walk{inequality, most_cells};
    if (!walk.proves(grid[k], kDepth)) {
      failed = true;
    }
    cells[k] = walk.cells;
  });
  if (failed) {
    result.reason =
        "somewhere in the set the expected value of W could not be shown to rise by the drift at most.";
    return result;
  }
  for (const std::int64_t count : cells) {
    result.cells += count;
  }
  result.verdict = Verdict::proved;
  result.reason = "the expected value of W rises by the drift at most.";
  return result;
}

}  // namespace veritrack::quadrature
