#include "analysis/quadrature/gaussian/lock_verification.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;

bool certainly_definite(const BlockCovariance<double>& p) {
  return certainly_positive(Interval(p.p11)) && certainly_positive(Interval(p.p22)) &&
         certainly_positive(Interval(p.p22) * Interval(p.p33) - rigor::square(Interval(p.p23)));
}

/// The first hypothesis on the inputs that does not hold, as a sentence; empty when all hold.
std::string objection(const trackers::ToneModel<Interval>& design, const LockSet& set) {
  if (!certainly_positive(design.r) || !certainly_positive(design.q2) || !certainly_not_negative(design.q1)) {
    return "the design is not one with q1 >= 0, q2 > 0 and r > 0.";
  }
  if (!(design.epsilon == Interval(0.0))) {
    return "this certificate is for epsilon = 0.";
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

/// A grid over (u1, u2, u3, s), u3 >= 0: the mirror image (e2, nu, P12, P13, v2, w) -> -(...) commutes with
/// the step and maps the set to itself.
std::vector<LevelCell> grid_of(const LockSet& set) {
  constexpr std::array<int, 4> kParts{8, 8, 4, 6};
  // A hair more than enough.
  const double radius = 1.000001 * std::sqrt(2.0 * set.level);
  const std::array<double, 4> low{-radius, -radius, 0.0, 0.0};
  const std::array<double, 4> high{radius, radius, radius, radius / std::sqrt(set.weight)};
  std::vector<LevelCell> cells{{}};
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<LevelCell> next;
    const auto node = [&](int k) { return low[i] + (high[i] - low[i]) * k / kParts[i]; };
    next.reserve(cells.size() * static_cast<std::size_t>(kParts[i]));
    for (const LevelCell& cell : cells) {
      for (int k = 0; k < kParts[i]; ++k) {
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
bool covers_set(const std::vector<LevelCell>& grid, const LockSet& set) {
  const Interval most = Interval(2.0) * Interval(set.level);
  const LevelCell& last = grid.back();
  for (std::size_t i = 0; i < 4; ++i) {
    const Interval weight = i == 3 ? Interval(set.weight) : Interval(1.0);
    if (!certainly_less_equal(most, weight * rigor::square(Interval(last.high[i])))) {
      return false;
    }
  }
  return grid.front().low[0] == -last.high[0] && grid.front().low[1] == -last.high[1] &&
         grid.front().low[2] == 0.0 && grid.front().low[3] == 0.0;
}

/// Proves the inequality on all these cells; nothing when one is not proved with so many parts, or all with
/// so many together. How many it took.
std::optional<std::int64_t> cells_of_proof(const DriftInequality& inequality,
                                           const std::vector<LevelCell>& grid, std::int64_t most_cells,
                                           std::int64_t most_together) {
  constexpr int kDepth = 40;
  std::atomic<std::int64_t> cells = 0;
  std::atomic<bool> failed = false;
  tbb::parallel_for(std::size_t{0}, grid.size(), [&](std::size_t k) {
    if (failed) {
      return;
    }
    const rigor::UpwardRounding upward_here;
    Walk walk{inequality, most_cells};
    if (!walk.proves(grid[k], kDepth) || (cells += walk.cells) > most_together) {
      failed = true;
    }
  });
  return failed ? std::nullopt : std::optional(cells.load());
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
  const std::vector<LevelCell> grid = grid_of(proposal);
  if (!covers_set(grid, proposal)) {
    result.reason = "the numbers are too large to be covered by cells.";
    return result;
  }
  const std::optional<std::int64_t> cells =
      cells_of_proof({design, proposal}, grid, most_cells, std::numeric_limits<std::int64_t>::max());
  if (!cells) {
    result.reason =
        "somewhere in the set the expected value of W could not be shown to rise by the drift at most.";
    return result;
  }
  result.cells = *cells;
  result.verdict = Verdict::proved;
  result.reason = "the expected value of W rises by the drift at most.";
  return result;
}

bool expects_cells(const trackers::ToneModel<Interval>& design, const LockSet& proposal, std::size_t every,
                   std::int64_t most_cells) {
  const rigor::UpwardRounding upward;
  if (!objection(design, proposal).empty()) {
    return false;
  }
  const std::vector<LevelCell> grid = grid_of(proposal);
  std::vector<LevelCell> some;
  for (std::size_t k = every / 2; k < grid.size(); k += every) {
    some.push_back(grid[k]);
  }
  const std::int64_t share =
      most_cells * static_cast<std::int64_t>(some.size()) / static_cast<std::int64_t>(grid.size());
  return cells_of_proof({design, proposal}, some, share, share).has_value();
}

}  // namespace veritrack::quadrature
