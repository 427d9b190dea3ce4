// Does the expected value of W = exp(level) rise by at most the drift, wherever the level is at most L?
#pragma once

#include <array>
#include <optional>

#include "analysis/quadrature/gaussian/drift_form.hpp"

namespace veritrack::quadrature {

/// A box of (u1, u2, u3, s), u = T e.
struct LevelCell {
  std::array<double, 4> low, high;
};

/// What the look at a cell found.
struct CellDrift {
  bool holds = false;  ///< true only when the inequality holds wherever in the cell the level is at most L
  /// What each variable contributes to the spread, for the choice of where to bisect.
  std::array<double, 4> influence{};
};

/// Looks at cells for one set. Every function needs the upward mode.
class DriftInequality {
 public:
  /// The set must have passed the checks of verify_lock_set on its ranges.
  DriftInequality(const trackers::ToneModel<rigor::Interval>& design, const LockSet& set);

  /// True only when no point of the cell has a level of at most L.
  [[nodiscard]] bool outside(const LevelCell& cell) const;

  [[nodiscard]] CellDrift check(const LevelCell& cell) const;

  /// How much of the inequality is left at a point, relative to 1 + twice its level; negative where it fails.
  /// In floating point, with bounds as those of `check` in a cell without width: for searches.
  [[nodiscard]] double margin_at(const std::array<double, 4>& x) const;

 private:
  struct CellStep;
  struct ImageLevel;
  /// True only when the level is one of the images everywhere in the cell: (3) of docs/gaussian.md.
  [[nodiscard]] bool is_level(const CellStep& step, const ImageLevel& level) const;
  [[nodiscard]] std::optional<ImageLevel> find_level(const CellStep& step) const;
  /// A lower bound on the part of l that hardly changes.
  [[nodiscard]] rigor::Interval constant_over(const LevelCell& cell) const;

  LockSet set_;
  LockSetting<rigor::Interval> setting_;
  LockSetting<double> rough_;
};

}  // namespace veritrack::quadrature
