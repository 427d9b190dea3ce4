#include "analysis/quadrature/gaussian/lock_cover.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "analysis/search/bisection_cover.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

bool is_apart(const LevelCovariance<double>& p) {
  return p.p12 == 0.0 && p.p13 == 0.0;
}

/// A part of the grid, and how often it may still be halved.
struct Part {
  LevelCell cell;
  int depth;
};

/// Halved along the side that matters most; nothing when it is too deep.
std::optional<std::array<Part, 2>> halves_of(const Part& part, const CellDrift& found) {
  if (part.depth == 0) {
    return std::nullopt;
  }
  const auto side = static_cast<std::size_t>(std::distance(
      found.influence.begin(), std::max_element(found.influence.begin(), found.influence.end())));
  std::array<Part, 2> halves{Part{part.cell, part.depth - 1}, Part{part.cell, part.depth - 1}};
  halves[0].cell.high[side] = halves[1].cell.low[side] = 0.5 * (part.cell.low[side] + part.cell.high[side]);
  return halves;
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

bool has_mirror_image(const trackers::ToneModel<Interval>& design, const LockSet& set) {
  return design.epsilon == Interval(0.0) && set.bias[1] == 0.0 && set.bias[2] == 0.0 &&
         is_apart(set.centre) && is_apart(set.spread_above) && is_apart(set.spread_below);
}

std::optional<std::int64_t> cells_of_proof(const LockSet& set, bool half, const CellLook& look,
                                           const CoverLimits& limits) {
  constexpr int kDepth = 40;
  constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();
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
    std::int64_t looked = 0;  // cells outside are free
    const auto look_at = [&](const Part& part) -> search::CellDecision<Part> {
      if (is_outside(set, part.cell)) {
        return {true};
      }
      if (++looked > limits.cells_in_part) {
        return {};
      }
      const CellDrift found = look(part.cell);
      return {found.holds, halves_of(part, found)};
    };
    if (!search::cover_by_bisection(Part{grid[k], kDepth}, kUnlimited, look_at).is_proved ||
        (cells += looked) > limits.cells) {
      failed = true;
    }
  });
  return failed ? std::nullopt : std::optional(cells.load());
}

}  // namespace veritrack::quadrature
