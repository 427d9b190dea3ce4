// Does the expected value of W = exp(level) shrink, up to the drift, wherever the level is at most L?
#pragma once

#include "analysis/quadrature/gaussian/level_cell.hpp"

namespace veritrack::quadrature {

/// Looks at cells for one set. Every function needs the upward mode.
class DriftInequality {
 public:
  /// The set must have passed the checks of verify_lock_set on its ranges.
  DriftInequality(const trackers::ToneModel<rigor::Interval>& design, const LockSet& set);

  /// `holds` is true only when (7) of docs/gaussian.md holds everywhere in the cell.
  [[nodiscard]] CellDrift check(const LevelCell& cell) const;

  /// How much of the inequality is left at a point, relative to 1 + twice its level; negative where it fails.
  /// In floating point, with bounds as those of `check` in a cell without width: for searches.
  [[nodiscard]] double margin_at(const std::array<double, 4>& x) const;

 private:
  LockSet set_;
  LockSettings settings_;
};

}  // namespace veritrack::quadrature
