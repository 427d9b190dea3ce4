#include "analysis/model/tube_errors.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>

#include "analysis/model/tube_models.hpp"
#include "analysis/rigor/ball_model.hpp"

namespace veritrack::model {

namespace {

using rigor::BallModel;
using rigor::Interval;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TubeCell cell_of(const ErrorGrid& grid, std::size_t number) {
  const auto phases = static_cast<std::size_t>(grid.phases);
  const std::size_t row = number / phases;
  const auto i = static_cast<double>(number % phases);
  const auto j = static_cast<double>(row);
  return {(i + 0.5) / grid.phases, 0.5 / grid.phases, (2.0 * j + 1.0) / grid.frequencies - 1.0,
          1.0 / grid.frequencies};
}

void require_grid(const ErrorGrid& grid) {
  const auto is_power_of_two = [](int n) { return n > 0 && (n & (n - 1)) == 0; };
  if (!is_power_of_two(grid.phases) || !is_power_of_two(grid.frequencies)) {
    throw std::invalid_argument("a grid that is none");
  }
}

/// Calls `work` for each cell, in any order; each in the upward rounding mode, with ball models of so many
/// variables.
template <typename Work>
void for_each_cell(const TrackerModel& model, const Tube& tube, const ErrorGrid& grid, const Work& work) {
  require_grid(grid);
  require_sizes(model, tube);
  const auto cells = static_cast<std::size_t>(grid.phases) * static_cast<std::size_t>(grid.frequencies);
  tbb::parallel_for(std::size_t{0}, cells, [&](std::size_t number) {
    const rigor::BallModelScope scope(static_cast<int>(tube.curve.size()), 0);
    work(number, frame_of(model, tube, cell_of(grid, number), FrameParts::here));
  });
}

std::size_t cells_of(const ErrorGrid& grid) {
  return static_cast<std::size_t>(grid.phases) * static_cast<std::size_t>(grid.frequencies);
}

/// What is known of h - omega in a cell.
struct CellErrors {
  Interval error = Interval::empty();
  BallModel::MeanInZ mean;
};

BallModel frequency_error(const TrackerModel& model, const CellFrame& frame,
                          const std::vector<BallModel>& state) {
  return frequency_of(model, state) - frame.frequency;
}

}  // namespace

TubeErrors bound_errors(const TrackerModel& model, const Tube& tube, double radius, const ErrorGrid& grid) {
  const rigor::UpwardRounding upward;
  require_grid(grid);
  std::vector<CellErrors> cells(cells_of(grid));
  for_each_cell(model, tube, grid, [&](std::size_t number, const CellFrame& frame) {
    const BallModel error = frequency_error(model, frame, state_in(frame.here, radius));
    cells[number] = {error.range(), error.mean_in_z()};
  });
  TubeErrors nothing_known{
      Interval::empty(), Interval::empty(), std::numeric_limits<double>::quiet_NaN(), {}};
  TubeErrors result{Interval::empty(), Interval::empty(), 0.0, {}};
  const auto phases = static_cast<std::size_t>(grid.phases);
  for (std::size_t first = 0; first < cells.size(); first += phases) {
    Interval range = cells[first].error;
    // The phases of a row see the same z, so that what a frequency adds at one phase and takes away at
    // another cancels.
    BallModel::MeanInZ sum;
    sum.powers.fill(Interval(0.0));
    for (std::size_t number = first; number < first + phases; ++number) {
      if (rigor::is_empty(cells[number].error)) {
        return nothing_known;
      }
      range = hull(range, cells[number].error);
      sum += cells[number].mean;
    }
    const Interval total = sum.range();
    if (rigor::is_empty(total)) {
      return nothing_known;
    }
    const Interval mean = total / Interval(static_cast<double>(grid.phases));
    result.error = first == 0 ? range : hull(result.error, range);
    result.mean = first == 0 ? mean : hull(result.mean, mean);
    const double ripple = (Interval(range.upper()) - Interval(range.lower())).upper();
    result.ripple = std::max(result.ripple, ripple);
    const TubeCell place = cell_of(grid, first);
    result.slices.push_back({tube.frequency + tube.half_width * (place.z - place.half_z),
                             tube.frequency + tube.half_width * (place.z + place.half_z), mean, ripple});
  }
  return result;
}

double bound_reach(const TrackerModel& model, const Tube& tube, double radius, const ErrorGrid& grid) {
  const rigor::UpwardRounding upward;
  require_grid(grid);
  std::vector<double> reaches(cells_of(grid), 0.0);
  for_each_cell(model, tube, grid, [&](std::size_t number, const CellFrame& frame) {
    // The direction in which the error grows most at the middle of the cell; any would do.
    const BallModel error = frequency_error(model, frame, state_in(frame.here, radius));
    const rigor::BallMonomials::Class& linear =
        error.monomials().classes()[error.monomials().class_of(1, 0, 0, 0)];
    double length = 0.0;
    for (std::size_t i = linear.first; i < linear.last; ++i) {
      length += error.coefficients()[i] * error.coefficients()[i];
    }
    length = std::sqrt(length) * (1.0 + 1e-12);
    double reach = kInfinity;
    for (const double sign : {1.0, -1.0}) {
      std::vector<BallModel> x;
      Interval square_of_length(0.0);
      for (std::size_t i = linear.first; i < linear.last; ++i) {
        const double component = sign * error.coefficients()[i] / length;
        x.emplace_back(component);
        square_of_length = square_of_length + square(Interval(component));
      }
      const Interval range = frequency_error(model, frame, state_in(frame.here, radius, x)).range();
      const bool is_known =
          rigor::certainly_less_equal(square_of_length, Interval(1.0)) && !rigor::is_empty(range);
      reach = std::min(reach, !is_known ? 0.0 : sign > 0.0 ? range.lower() : -range.upper());
    }
    reaches[number] = reach > 0.0 ? reach : 0.0;
  });
  return *std::min_element(reaches.begin(), reaches.end());
}

double bound_start(const TrackerModel& model, const Tube& tube, const std::vector<Interval>& deviations,
                   const ErrorGrid& grid) {
  const rigor::UpwardRounding upward;
  require_grid(grid);
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    if (deviations[i].lower() != 0.0 || deviations[i].upper() != 0.0) {
      free.push_back(i);
    }
  }
  constexpr std::size_t kMostFree = 12;
  if (deviations.size() != tube.curve.size() || free.size() > kMostFree) {
    throw std::invalid_argument("deviations that do not fit the states, or too many");
  }
  // |U^-1 d| is convex in d: its largest value is at a corner of the box, up to the sign of all.
  const std::size_t corners = free.empty() ? 1 : std::size_t{1} << (free.size() - 1);
  std::vector<double> levels(cells_of(grid), kInfinity);
  for_each_cell(model, tube, grid, [&](std::size_t number, const CellFrame& frame) {
    double level = is_shape(frame.here) ? 0.0 : kInfinity;
    for (std::size_t corner = 0; corner < corners; ++corner) {
      std::vector<BallModel> deviation(deviations.size());
      for (std::size_t k = 0; k < free.size(); ++k) {
        const BallModel size(deviations[free[k]]);
        deviation[free[k]] = (corner >> k & 1U) != 0 ? -size : size;
      }
      BallModel sum;
      for (const BallModel& x : in_units_of(frame.here, deviation)) {
        sum = sum + square(x);
      }
      const Interval range = sum.range();
      const double length =
          rigor::is_empty(range) ? kInfinity : sqrt(Interval(std::max(range.upper(), 0.0))).upper();
      level = std::max(level, length);
    }
    levels[number] = level;
  });
  return *std::max_element(levels.begin(), levels.end());
}

}  // namespace veritrack::model
