// Does the mean square of the frequency error while in lock stay below a bound?
#pragma once

#include "analysis/quadrature/gaussian/level_cell.hpp"

namespace veritrack::quadrature {

/// The bound on the mean square for a LockSet: with U = |R (e - f)|^2 + g s(P)^2 + beta W,
///     E[U(k+1) | k] <= U(k) + h (c - nu(k)^2)
/// everywhere in the set, nu being the whole frequency error: docs/gaussian.md, section 14. All numbers are
/// exact doubles.
struct LockMeanSquare {
  BlockMetric<double> metric;      ///< R, positive on the diagonal, with frequency^2 >= h
  double weight = 0.0;             ///< g > 0
  double share = 0.0;              ///< beta >= 0
  double rate = 0.0;               ///< h > 0, (rad/sample)^-2
  double bound = 0.0;              ///< c > 0, (rad/sample)^2
  std::array<double, 3> offset{};  ///< f; zero without a leak
};

/// An upper bound on the square of the norm of R T^-1. Needs the upward mode.
[[nodiscard]] rigor::Interval relative_norm_squared(const LockMeanSquare& mean_square, const LockSet& set);

/// An enclosure of |R f|. Needs the upward mode.
[[nodiscard]] rigor::Interval offset_length(const LockMeanSquare& mean_square);

/// Looks at cells of a set. Every function needs the upward mode.
class MeanSquareInequality {
 public:
  /// The set must have passed verify_lock_set, the form the checks of verify_mean_square on its ranges.
  MeanSquareInequality(const trackers::ToneModel<rigor::Interval>& design, const LockSet& set,
                       const LockMeanSquare& mean_square);

  /// `holds` is true only when the promise of LockMeanSquare is true everywhere in the cell.
  [[nodiscard]] CellDrift check(const LevelCell& cell) const;

  /// The least c for which the inequality holds at a point, at the worse end of the frequencies,
  /// (rad/sample)^2. In floating point: for searches.
  [[nodiscard]] double needed_at(const std::array<double, 4>& x) const;

 private:
  LockSet set_;
  LockMeanSquare mean_square_;
  LockSettings settings_;
  LockSettings next_;  ///< with R as the metric
};

}  // namespace veritrack::quadrature
