// Branch and bound: encloses the minimum of a function over a box, and so proves what a search proposes.
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

/// A part of the box with what is known of the function on it.
template <int N>
struct Cell {
  rigor::IntervalVector<N> box;
  double lower = -std::numeric_limits<double>::infinity();
  int split = 0;                                               ///< the direction in which to divide it
  double at_middle = std::numeric_limits<double>::infinity();  ///< an upper bound on the value at its middle
  bool holds_no_minimizer = false;
};

/// The worse cell comes later in a heap of best cells; ties are broken by place, for determinism.
template <int N>
[[nodiscard]] bool is_worse(const Cell<N>& a, const Cell<N>& b) {
  if (a.lower != b.lower) {
    return a.lower > b.lower;
  }
  for (int i = 0; i < N; ++i) {
    if (a.box[i].lower() != b.box[i].lower()) {
      return a.box[i].lower() > b.box[i].lower();
    }
  }
  return false;
}

/// Where to divide an interval: in the middle, or in the geometric middle when it spans a large ratio.
[[nodiscard]] inline double division(const rigor::Interval& x) {
  constexpr double kLargeRatio = 4.0;
  if (x.lower() > 0.0 && x.upper() / x.lower() > kLargeRatio) {
    return std::clamp(std::sqrt(x.lower()) * std::sqrt(x.upper()), x.lower(), x.upper());
  }
  return rigor::midpoint(x);
}

template <int N>
[[nodiscard]] rigor::Vector<N> middle(const rigor::IntervalVector<N>& box) {
  return box.unaryExpr([](const rigor::Interval& x) { return division(x); });
}

/// Where the function certainly increases or decreases along a direction, its minimum over the cell lies on a
/// face. When that face is inside the domain the function is lower still beyond it (it is differentiable
/// there, and its slope is not zero), and the cell contains no minimizer; when it is on the domain's boundary
/// the cell shrinks to it. True when the cell changed.
template <int N>
bool shrink_by_slopes(const rigor::Dual<rigor::Interval, N>& value, const rigor::IntervalVector<N>& domain,
                      Cell<N>& cell) {
  bool shrank = false;
  for (int i = 0; i < N; ++i) {
    const bool rises = certainly_positive(value.derivative(i));
    const bool falls = certainly_negative(value.derivative(i));
    if (!(cell.box[i].lower() < cell.box[i].upper()) || (!rises && !falls)) {
      continue;
    }
    const double face = rises ? cell.box[i].lower() : cell.box[i].upper();
    if (face != (rises ? domain[i].lower() : domain[i].upper())) {
      cell.holds_no_minimizer = true;
      return false;
    }
    cell.box[i] = rigor::Interval(face);
    shrank = true;
  }
  return shrank;
}

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

/// The remaining cells, and the bounds that follow from them.
template <int N>
class CellHeap {
 public:
  explicit CellHeap(std::size_t expected) { cells_.reserve(expected); }

  void add(const Cell<N>& cell) {
    cells_.push_back(cell);
    std::push_heap(cells_.begin(), cells_.end(), is_worse<N>);
  }
  [[nodiscard]] bool empty() const { return cells_.empty(); }
  /// No value in any cell is below it. The heap must not be empty.
  [[nodiscard]] double lower() const { return cells_.front().lower; }
  Cell<N> take_best() {
    std::pop_heap(cells_.begin(), cells_.end(), is_worse<N>);
    Cell<N> best = cells_.back();
    cells_.pop_back();
    return best;
  }
  /// The hull of the cells that may contain a value as low as `upper`; `otherwise` when there are none.
  [[nodiscard]] rigor::IntervalVector<N> hull_below(double upper,
                                                    const rigor::IntervalVector<N>& otherwise) const {
    rigor::IntervalVector<N> hull = otherwise;
    bool first = true;
    for (const Cell<N>& cell : cells_) {
      if (!(cell.lower > upper)) {
        hull = first ? cell.box : rigor::hull(hull, cell.box);
        first = false;
      }
    }
    return hull;
  }

 private:
  std::vector<Cell<N>> cells_;
};

/// The two halves of a cell, appended to `batch`. False when no double lies between the ends.
template <int N>
bool divide(const Cell<N>& cell, std::vector<Cell<N>>& batch) {
  const rigor::Interval whole = cell.box[cell.split];
  const double at = division(whole);
  if (!(whole.lower() < at && at < whole.upper())) {
    return false;
  }
  Cell<N> part;
  part.box = cell.box;
  part.lower = cell.lower;
  part.box[cell.split] = rigor::Interval::from_bounds(whole.lower(), at);
  batch.push_back(part);
  part.box[cell.split] = rigor::Interval::from_bounds(at, whole.upper());
  batch.push_back(part);
  return true;
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
