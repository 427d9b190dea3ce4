// Does the mean square of the frequency error while in lock stay below a bound?
#pragma once

#include "analysis/quadrature/gaussian/level_cell.hpp"

namespace veritrack::quadrature {

/// What bounds the mean square for a LockSet: with U = |R e|^2 + g s(P)^2 + beta W,
///     E[U(k+1) | k] <= U(k) + h (c - nu(k)^2)
/// everywhere in the set: docs/gaussian.md, section 8.
struct LockMeanSquare {
  BlockMetric<double> metric;  ///< R, invertible
  double weight = 0.0;         ///< g > 0
  double share = 0.0;          ///< beta >= 0
  double rate = 0.0;           ///< h > 0, (rad/sample)^-2
  double bound = 0.0;          ///< c > 0, (rad/sample)^2
};

/// Looks at cells of a set. Every function needs the upward mode.
class MeanSquareInequality {
 public:
  /// The set must have passed the checks of verify_lock_set.
  MeanSquareInequality(const trackers::ToneModel<rigor::Interval>& design, const LockSet& set,
                       const LockMeanSquare& mean_square);

  [[nodiscard]] CellDrift check(const LevelCell& cell) const;

  /// The least c for which the inequality holds at a point, (rad/sample)^2. In floating point: for searches.
  [[nodiscard]] double needed_at(const std::array<double, 4>& x) const;

 private:
  LockSet set_;
  LockMeanSquare mean_square_;
  LockSettings settings_;
  LockSettings next_;  ///< with R as the metric
};

}  // namespace veritrack::quadrature
