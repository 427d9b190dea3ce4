#include "analysis/model/tube/tube_errors.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

#include "analysis/model/step/tube_models.hpp"
#include "analysis/rigor/ball_model.hpp"
#include "analysis/rigor/larger_or_nan.hpp"

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
  if (!is_power_of_two(grid.phases) || !is_power_of_two(grid.frequencies) || !is_power_of_two(grid.finer)) {
    throw std::invalid_argument("an invalid grid");
  }
}

/// The tube without the bounds of a covariance, which do not concern errors.
Tube of_estimate(const Tube& tube) {
  Tube estimate = tube;
  estimate.covariance_low.clear();
  estimate.covariance_high.clear();
  return estimate;
}

/// Calls `work` for each cell, in any order; each in the upward rounding mode, with ball models of this many
/// variables.
template <typename Work>
void for_each_cell(const TrackerModel& model, const Tube& tube, const ErrorGrid& grid, const Work& work) {
  require_grid(grid);
  require_sizes(model, tube);
  const Tube estimate = of_estimate(tube);
  const auto cells = static_cast<std::size_t>(grid.phases) * static_cast<std::size_t>(grid.frequencies);
  tbb::parallel_for(std::size_t{0}, cells, [&](std::size_t number) {
    const rigor::BallModelScope scope(static_cast<int>(tube.curve.size()), 0);
    work(number, frame_of(model, estimate, cell_of(grid, number), FrameParts::here));
  });
}

std::size_t cells_of(const ErrorGrid& grid) {
  return static_cast<std::size_t>(grid.phases) * static_cast<std::size_t>(grid.frequencies);
}

/// Powers of z from z^1 on, and as many.
constexpr std::size_t kPowers = 4;

/// The bounds on h - omega in a cell.
struct CellErrors {
  Interval error = Interval::empty();
  BallModel::MeanInZ mean;
  /// h - omega is the sum of in_z[d - 1] z^d and of this.
  Interval rest = Interval::empty();
  std::array<double, kPowers> in_z{};
};

/// Separates the part that depends on z alone, whose coefficients are exact numbers.
void split_in_z(const BallModel& error, CellErrors& cell) {
  BallModel rest = error;
  BallModel power(1.0);
  for (std::size_t d = 1; d <= kPowers; ++d) {
    power = power * BallModel::z();
    const rigor::BallMonomials& monomials = error.monomials();
    const std::size_t place = monomials.classes()[monomials.class_of(0, 0, 0, static_cast<int>(d))].first;
    cell.in_z.at(d - 1) = error.coefficients()[place];
    rest.add_multiple(power, -cell.in_z.at(d - 1));
  }
  cell.rest = rest.range();
}

/// Approximately the mean of a row's errors as a polynomial in z; any numbers are valid.
std::array<double, kPowers> common_of(std::span<const CellErrors> row) {
  std::array<double, kPowers> common{};
  for (const CellErrors& cell : row) {
    for (std::size_t d = 0; d < kPowers; ++d) {
      common.at(d) += cell.in_z.at(d) / static_cast<double>(row.size());
    }
  }
  return common;
}

/// Contains h - omega minus the common part of all phases of a row. Empty when nothing is known.
Interval without(const std::array<double, kPowers>& common, const CellErrors& cell) {
  Interval here = cell.rest;
  for (std::size_t d = 0; d < kPowers; ++d) {
    const Interval left = Interval(cell.in_z.at(d)) - Interval(common.at(d));
    // The index d is that of z^(d + 1), between -1 and 1, of an even power between 0 and 1.
    here = here + hull(d % 2 == 1 ? Interval(0.0) : -left, left);
  }
  return rigor::is_finite(here) ? here : Interval::empty();
}

/// The bounds on the parts of the cell at this place of a row; empty where it is not divided.
using PartsOfCell = std::function<std::vector<CellErrors>(std::size_t place)>;

/// Contains the same in a cell, by its parts where there are any.
Interval without(const std::array<double, kPowers>& common, const std::vector<CellErrors>& parts,
                 const Interval& whole) {
  std::optional<Interval> all;
  for (const CellErrors& part : parts) {
    const Interval range = without(common, part);
    if (rigor::is_empty(range)) {
      return whole;
    }
    all = all ? hull(*all, range) : range;
  }
  return all.value_or(whole);
}

/// At each frequency of a row of cells, the largest h - omega minus the smallest is at most this.
double ripple_of(std::span<const CellErrors> row, const PartsOfCell& parts_of) {
  const std::array<double, kPowers> common = common_of(row);
  std::vector<Interval> ranges;
  ranges.reserve(row.size());
  double at_least = -kInfinity;  // the largest value; the smallest one is at most:
  double at_most = kInfinity;
  for (const CellErrors& cell : row) {
    ranges.push_back(without(common, cell));
    if (rigor::is_empty(ranges.back())) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    at_least = std::max(at_least, ranges.back().lower());
    at_most = std::min(at_most, ranges.back().upper());
  }
  Interval all = ranges.front();
  bool is_first = true;
  for (std::size_t place = 0; place < ranges.size(); ++place) {
    const bool may_be_extreme = ranges[place].upper() > at_least || ranges[place].lower() < at_most;
    const Interval here = may_be_extreme ? without(common, parts_of(place), ranges[place]) : ranges[place];
    all = is_first ? here : hull(all, here);
    is_first = false;
  }
  return (Interval(all.upper()) - Interval(all.lower())).upper();
}

BallModel frequency_error(const TrackerModel& model, const CellFrame& frame,
                          const std::vector<BallModel>& state) {
  return frequency_of(model, state) - frame.frequency;
}

}  // namespace

TubeErrors bound_errors(const TrackerModel& model, const Tube& tube, double radius, const ErrorGrid& grid) {
  const rigor::UpwardRounding upward;
  require_grid(grid);
  std::vector<CellErrors> cells(cells_of(grid));
  const auto errors_in = [&](const CellFrame& frame) {
    const BallModel error = frequency_error(model, frame, state_in(frame.here, radius));
    CellErrors cell{error.range(), error.mean_in_z()};
    split_in_z(error, cell);
    return cell;
  };
  for_each_cell(model, tube, grid,
                [&](std::size_t number, const CellFrame& frame) { cells[number] = errors_in(frame); });
  // The parts of a cell in phase.
  const Tube estimate = of_estimate(tube);
  const auto parts_of = [&](std::size_t number) {
    const rigor::BallModelScope scope(static_cast<int>(tube.curve.size()), 0);
    const TubeCell whole = cell_of(grid, number);
    const double half = whole.half_turn / grid.finer;
    std::vector<CellErrors> parts;
    for (int i = 0; i < grid.finer && grid.finer > 1; ++i) {
      const TubeCell part{whole.turn - whole.half_turn + (2.0 * i + 1.0) * half, half, whole.z, whole.half_z};
      parts.push_back(errors_in(frame_of(model, estimate, part, FrameParts::here)));
    }
    return parts;
  };
  TubeErrors nothing_known{
      Interval::empty(), Interval::empty(), std::numeric_limits<double>::quiet_NaN(), {}};
  TubeErrors result{Interval::empty(), Interval::empty(), 0.0, {}};
  const auto phases = static_cast<std::size_t>(grid.phases);
  for (std::size_t first = 0; first < cells.size(); first += phases) {
    Interval range = cells[first].error;
    // The phases of a row see the same z, so that contributions of a frequency with opposite signs at
    // different phases cancel.
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
    const double ripple = ripple_of(std::span(cells).subspan(first, phases),
                                    [&](std::size_t place) { return parts_of(first + place); });
    result.ripple = rigor::larger_or_nan(result.ripple, ripple);
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
    // The direction in which the error grows most at the middle of the cell; any is valid.
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
      // cannot bind (square_of_length): it was divided by a little more than its root, and what is no number
      // has no range.
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
          rigor::is_finite(range) ? sqrt(Interval(std::max(range.upper(), 0.0))).upper() : kInfinity;
      level = std::max(level, length);
    }
    levels[number] = level;
  });
  return *std::max_element(levels.begin(), levels.end());
}

}  // namespace veritrack::model
