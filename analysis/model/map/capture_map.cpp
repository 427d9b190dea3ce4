#include "analysis/model/map/capture_map.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/model/map/capture_phase.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

/// The starts at a cell of phases, and at its halves those for which the cell is too coarse.
PhaseAnswer follow_halving(const CaptureProblem& problem, const CaptureGrid& grid,
                           const std::vector<char>& wanted, const CaptureOptions& options,
                           const PhaseCell& phases, int halvings) {
  PhaseAnswer answer = follow_at(problem, grid, wanted, options, phases);
  const auto is_coarse = [](CaptureOutcome outcome) { return outcome == CaptureOutcome::too_coarse; };
  if (halvings == 0 || std::none_of(answer.outcomes.begin(), answer.outcomes.end(), is_coarse)) {
    return answer;
  }
  std::vector<char> left(grid.cells(), 0);
  for (std::size_t cell = 0; cell < left.size(); ++cell) {
    if (is_coarse(answer.outcomes[cell])) {
      left[cell] = 1;
      answer.outcomes[cell] = CaptureOutcome::captured;
      answer.samples[cell] = 0;
    }
  }
  const double half = phases.half_turn / 2.0;
  for (const double turn : {phases.turn - half, phases.turn + half}) {
    const PhaseAnswer part = follow_halving(problem, grid, left, options, {turn, half}, halvings - 1);
    for (std::size_t cell = 0; cell < left.size(); ++cell) {
      if (left[cell] == 0) {
        continue;
      }
      if (part.outcomes[cell] == CaptureOutcome::captured) {
        answer.samples[cell] = std::max(answer.samples[cell], part.samples[cell]);
      } else {
        answer.outcomes[cell] = CaptureOutcome::given_up;
        left[cell] = 0;
      }
    }
  }
  return answer;
}

/// 0, 4, 2, 6, 1, 5, 3, 7: a failure anywhere is soon found.
std::vector<std::size_t> spread_order(std::size_t count) {
  std::vector<std::size_t> order(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t bit = 1, reversed = count / 2; bit < count; bit *= 2, reversed /= 2) {
      order[i] += (i & bit) != 0 ? reversed : 0;
    }
  }
  return order;
}

/// The ring of a cell, from 0 in the middle; of equal widths.
int ring_of(const CaptureGrid& grid, std::size_t cell, int rings) {
  const auto away = [](std::size_t number, std::size_t count) {
    return std::fabs(2.0 * static_cast<double>(number) + 1.0 - static_cast<double>(count)) /
           static_cast<double>(count);
  };
  const double distance =
      std::max(away(cell % grid.columns(), grid.columns()), away(cell / grid.columns(), grid.rows()));
  return std::min(static_cast<int>(distance * rings), rings - 1);
}

/// Follows the remaining cells at all phases and removes those that fail somewhere. False when the deadline
/// came before all phases were examined: nothing is known then.
bool follow_all_phases(const CaptureProblem& problem, const CaptureGrid& grid, std::vector<char>& left,
                       const CaptureOptions& options, std::vector<CapturedCell>& cells,
                       const CaptureProgress& progress) {
  const auto phases = static_cast<std::size_t>(options.phases);
  const std::vector<std::size_t> order = spread_order(phases);
  // Cells that are given up in one generation are not followed in the next.
  constexpr std::size_t kGeneration = 8;
  for (std::size_t first = 0; first < phases; first += kGeneration) {
    const std::size_t count = std::min(kGeneration, phases - first);
    std::vector<PhaseAnswer> answers(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t number) {
      const rigor::UpwardRounding upward;
      const double half = 0.5 / static_cast<double>(phases);
      const double turn = (static_cast<double>(order[first + number]) + 0.5) / static_cast<double>(phases);
      answers[number] = follow_halving(problem, grid, left, options, {turn, half}, options.phase_halvings);
    });
    if (options.deadline.is_over()) {
      return false;
    }
    for (const PhaseAnswer& answer : answers) {
      for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        if (answer.outcomes[cell] != CaptureOutcome::captured) {
          left[cell] = 0;
        }
        if (left[cell] != 0) {
          cells[cell].samples = std::max(cells[cell].samples, answer.samples[cell]);
        }
      }
    }
    progress(static_cast<double>(first + count) / static_cast<double>(phases));
  }
  return true;
}

}  // namespace

CaptureGrid capture_grid(std::size_t x_state, double x_range, std::size_t y_state, double y_range,
                         int count) {
  const bool is_grid = x_range > 0.0 && y_range > 0.0 && std::isfinite(x_range) && std::isfinite(y_range) &&
                       count > 0 && x_state != y_state;
  if (!is_grid) {
    throw std::invalid_argument("a grid of deviations needs two states, ranges and a number of cells");
  }
  // The ends on both sides of 0 are the same numbers up to the sign.
  const rigor::NearestRounding nearest;
  CaptureGrid grid{x_state, y_state, {}, {}};
  const auto cells = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i <= cells; ++i) {
    const double place = (2.0 * static_cast<double>(i) - count) / count;
    grid.x.push_back(place * x_range);
    grid.y.push_back(place * y_range);
  }
  return grid;
}

std::vector<CapturedCell> prove_captured(const CaptureProblem& problem, const CaptureGrid& grid,
                                         const std::vector<char>& wanted, const CaptureOptions& options,
                                         const CaptureProgress& progress) {
  const auto phases = static_cast<std::size_t>(std::max(options.phases, 0));
  const bool is_power = phases > 0 && (phases & (phases - 1)) == 0;
  if (!is_power || wanted.size() != grid.cells() || options.stride == 0 || options.rings < 1) {
    throw std::invalid_argument("a grid of deviations that does not fit");
  }
  const rigor::UpwardRounding here;
  std::vector<CapturedCell> cells(grid.cells());
  for (int ring = 0; ring < options.rings; ++ring) {
    std::vector<char> left = wanted;
    for (std::size_t cell = 0; cell < left.size(); ++cell) {
      left[cell] = wanted[cell] != 0 && ring_of(grid, cell, options.rings) == ring ? 1 : 0;
    }
    const std::vector<char> asked = left;
    const bool is_finished = follow_all_phases(problem, grid, left, options, cells, [&](double share) {
      if (progress) {
        progress((ring + share) / options.rings);
      }
    });
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      if (asked[cell] != 0) {
        cells[cell].is_proved = is_finished && left[cell] != 0;
        cells[cell].is_unfinished = !is_finished;
        cells[cell].samples = cells[cell].is_proved ? cells[cell].samples : 0;
      }
    }
  }
  return cells;
}

}  // namespace veritrack::model
