// Branch and bound: encloses the minimum of a function over a box, and so proves the proposals of a search.
//
// The function is a template over its scalar, called with vectors of Interval and of Dual<Interval, N>; where
// its result is finite it must be defined and (for duals) differentiable, which is the promise of
// interval.hpp and dual.hpp. A function without useful derivatives may return entire intervals for them.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/search/cells.hpp"

namespace veritrack::search {

/// When to stop, and how many cells to examine between two decisions. The result depends on `batch` but not
/// on the number of threads; batches above 1 are evaluated in parallel.
template <int N>
struct BranchAndBoundSettings {
  double relative_tolerance = 1e-10;  ///< of the minimum
  double absolute_tolerance = 0.0;
  std::int64_t cells = 100'000;  ///< at most
  int batch = 1;
  /// The search stops at a lower bound of at least this.
  double sufficient = std::numeric_limits<double>::infinity();
  /// The function depends on an unknown, so that its values are intervals even at a point. The minimum sought
  /// is that of their lower ends, and `upper` is such a lower end.
  bool of_lower_ends = false;
  /// Without finite slopes a cell is divided in the direction of the largest width times importance.
  rigor::Vector<N> importance = rigor::Vector<N>::Ones();
};

/// The minimum over a box lies in [lower, upper].
template <int N>
struct VerifiedMinimum {
  double lower = -std::numeric_limits<double>::infinity();  ///< no value is below it
  double upper = std::numeric_limits<double>::infinity();   ///< the value at `best` is at most this
  rigor::Vector<N> best;           ///< inside the box, NaN when no point had a finite value
  rigor::IntervalVector<N> where;  ///< contains every minimizer
  std::int64_t cells = 0;          ///< examined
  bool converged = false;          ///< within the tolerance
  /// [lower, upper], empty unless both are finite.
  [[nodiscard]] rigor::Interval value() const {
    const bool finite = std::isfinite(lower) && std::isfinite(upper);
    return finite ? rigor::Interval::from_bounds(lower, upper) : rigor::Interval::empty();
  }
};

namespace detail {

/// Evaluates the function over the cell and at its middle. Needs the upward mode.
template <int N, typename Function>
void examine(const Function& function, const rigor::IntervalVector<N>& domain,
             const BranchAndBoundSettings<N>& settings, Cell<N>& cell) {
  rigor::Dual<rigor::Interval, N> value;
  do {
    value = function(rigor::variables(cell.box));
  } while (rigor::is_finite(value.value()) && shrink_by_slopes(value, domain, cell));
  if (cell.holds_no_minimizer) {
    return;
  }
  const rigor::Vector<N> center = middle<N>(cell.box);
  const rigor::IntervalVector<N> point = rigor::to_interval(center);
  const rigor::Interval at_center = function(point);
  rigor::Interval linear = at_center;
  bool is_linear = true;
  for (int i = 0; i < N; ++i) {
    is_linear = is_linear && rigor::is_finite(value.derivative(i));
  }
  double steepest = -1.0;
  for (int i = 0; i < N; ++i) {
    if (!(cell.box[i].lower() < cell.box[i].upper())) {
      continue;
    }
    const rigor::Interval change = value.derivative(i) * (cell.box[i] - point[i]);
    linear += change;
    const double variation = is_linear ? width(change) : settings.importance[i] * width(cell.box[i]);
    if (variation > steepest) {
      steepest = variation;
      cell.split = i;
    }
  }
  const double reached = settings.of_lower_ends ? at_center.lower() : at_center.upper();
  if (reached < cell.at_middle && reached > -std::numeric_limits<double>::infinity()) {
    cell.at_middle = reached;
  }
  // NaN, an end of the empty enclosure, leaves the bound unchanged.
  for (const double bound : {value.value().lower(), linear.lower()}) {
    if (bound > cell.lower) {
      cell.lower = bound;
    }
  }
}

/// Examines all cells of a batch, in parallel when there are several.
template <int N, typename Function>
void examine_all(const Function& function, const rigor::IntervalVector<N>& domain,
                 const BranchAndBoundSettings<N>& settings, std::vector<Cell<N>>& batch) {
  if (batch.size() <= 2) {
    for (Cell<N>& cell : batch) {
      examine<N>(function, domain, settings, cell);
    }
    return;
  }
  tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t i) {
    const rigor::UpwardRounding upward;
    examine<N>(function, domain, settings, batch[i]);
  });
}

}  // namespace detail

/// Encloses the minimum of `function` over `box`. Best cells first, a batch at a time; mean-value form and
/// monotonicity test. Whatever the settings, `lower` is a bound; minus infinity means that the function could
/// not be evaluated somewhere (or that the box is not finite). Opens its own rounding scopes; allocates only
/// the list of cells.
template <int N, typename Function>
[[nodiscard]] VerifiedMinimum<N> minimize_globally(const Function& function,
                                                   const rigor::IntervalVector<N>& box,
                                                   const BranchAndBoundSettings<N>& settings = {}) {
  using Cell = detail::Cell<N>;
  const rigor::UpwardRounding upward;
  VerifiedMinimum<N> result;
  result.best.setConstant(std::numeric_limits<double>::quiet_NaN());
  result.where = box;
  if (!rigor::is_finite(box)) {
    return result;
  }
  detail::CellHeap<N> heap(64);
  std::vector<Cell> batch(1);
  batch.front().box = box;
  double indivisible = std::numeric_limits<double>::infinity();  // the lowest bound of cells that are points
  for (;;) {
    detail::examine_all<N>(function, box, settings, batch);
    result.cells += static_cast<std::int64_t>(batch.size());
    for (const Cell& cell : batch) {
      if (cell.at_middle < result.upper) {
        result.upper = cell.at_middle;
        result.best = detail::middle<N>(cell.box);
      }
    }
    for (const Cell& cell : batch) {
      const bool is_above = cell.lower > result.upper;
      if (!cell.holds_no_minimizer && !is_above) {
        heap.add(cell);
      }
    }
    if (heap.empty()) {
      // Only points that could not be divided remain; or, without a finite value anywhere, nothing.
      result.lower = std::isfinite(indivisible) ? std::min(indivisible, result.upper) : result.lower;
      break;
    }
    result.lower = std::min({heap.lower(), indivisible, result.upper});
    const double tolerance =
        std::max(settings.absolute_tolerance, settings.relative_tolerance * std::fabs(result.upper));
    result.converged = result.upper - result.lower <= tolerance;
    if (result.converged || result.lower >= settings.sufficient || result.cells + 2 > settings.cells) {
      break;
    }
    batch.clear();
    while (!heap.empty() && batch.size() < 2 * static_cast<std::size_t>(settings.batch)) {
      const Cell parent = heap.take_best();
      if (!detail::divide(parent, batch)) {
        indivisible = std::min(indivisible, parent.lower);
      }
    }
    if (batch.empty()) {
      result.lower = std::min(indivisible, result.upper);
      break;
    }
  }
  result.where = std::isfinite(indivisible) ? box : heap.hull_below(result.upper, box);
  return result;
}

}  // namespace veritrack::search
