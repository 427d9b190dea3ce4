#include "analysis/quadrature/gaussian/lock_cover.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <vector>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

bool is_apart(const LevelCovariance<double>& p) {
  return p.p12 == 0.0 && p.p13 == 0.0;
}

/// Bisects a cell until the inequality is proved on all parts.
struct Walk {
  const LockSet& set;
  const CellLook& look;
  std::int64_t most_cells;
  std::int64_t cells = 0;

  bool proves(const LevelCell& cell, int depth) {
    if (is_outside(set, cell)) {
      return true;
    }
    if (++cells > most_cells) {
      return false;
    }
    const CellDrift found = look(cell);
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

bool has_mirror_image(const trackers::ToneModel<Interval>& design, const LockSet& set) {
  return design.epsilon == Interval(0.0) && set.bias[1] == 0.0 && set.bias[2] == 0.0 &&
         is_apart(set.centre) && is_apart(set.spread_above) && is_apart(set.spread_below);
}

std::optional<std::int64_t> cells_of_proof(const LockSet& set, bool half, const CellLook& look,
                                           const CoverLimits& limits) {
  constexpr int kDepth = 40;
  const std::vector<LevelCell> grid = grid_of(set, half);
  if (!covers_set(grid, set, half)) {
    return std::nullopt;
  }
  std::atomic<std::int64_t> cells = 0;
  std::atomic<bool> failed = false;
  tbb::parallel_for(std::size_t{0}, grid.size(), [&](std::size_t k) {
    if (failed || k % limits.every != limits.every / 2) {
      return;
    }
    const rigor::UpwardRounding upward_here;
    Walk walk{set, look, limits.cells_in_part};
    if (!walk.proves(grid[k], kDepth) || (cells += walk.cells) > limits.cells) {
      failed = true;
    }
  });
  return failed ? std::nullopt : std::optional(cells.load());
}

}  // namespace veritrack::quadrature
