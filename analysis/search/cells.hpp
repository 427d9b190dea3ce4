// The cells of a branch and bound: parts of a box with bounds on a function there, the best first.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "analysis/rigor/derivatives.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::search::detail {

/// A part of the box with bounds on the function there.
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

}  // namespace veritrack::search::detail
