// Cells of (T e, s), the step over a cell, and a level of the images there.
#pragma once

#include <array>
#include <optional>

#include "analysis/quadrature/gaussian/level_step.hpp"

namespace veritrack::quadrature {

/// A box of (u1, u2, u3, s), u = T e.
struct LevelCell {
  std::array<double, 4> low, high;
};

/// The result of examining a cell.
struct CellDrift {
  bool holds = false;  ///< true only when the inequality is true wherever in the cell the level is at most L
  /// The contribution of each variable to the spread, to choose where to bisect.
  std::array<double, 4> influence{};
};

using CellDerivatives = rigor::Dual<rigor::Interval, 3>;

/// The design and a set, enclosed and roughly.
struct LockSettings {
  LockSettings(const trackers::ToneModel<rigor::Interval>& design, const LockSet& set);

  LockSetting<rigor::Interval> enclosed;
  LockSetting<double> rough;
};

/// A cell, and the images of its points: in the middle and over it. Needs the upward mode.
struct CellStep {
  CellStep(const LockSetting<rigor::Interval>& setting, const LevelCell& cell);

  /// Half the sides, that of s in the metric of the set.
  [[nodiscard]] std::array<double, 4> sizes(double weight) const;

  std::array<rigor::Interval, 3> middle;
  std::array<CellDerivatives, 3> range;
  /// The middle, with derivatives: of a convex function of these the tangent, which is below it in the cell.
  std::array<CellDerivatives, 3> tangent;
  std::array<double, 3> half_widths{};
  rigor::Interval level_middle;
  std::array<rigor::Interval, 2> ends;  ///< of the level, from its middle
  double level_width;
  LevelStep<rigor::Interval> at;
  LevelStep<CellDerivatives> over;
  LevelStep<double> roughly;
};

/// A level of the images, affine in u and in s: at the ends of s, in the middle of u and over the cell.
struct ImageLevel {
  std::array<rigor::Interval, 2> at;
  std::array<CellDerivatives, 2> over;
};

/// Bisect s when it is the widest side in the metric of the set, else the variable with the most influence: a
/// matter of speed.
void prefer_widest(const CellStep& step, const std::array<double, 3>& influence, CellDrift& found);

/// Nearly the least level of the images that is proved everywhere in the cell: (3) of docs/gaussian.md.
/// Needs the upward mode.
[[nodiscard]] std::optional<ImageLevel> find_image_level(const LockSettings& settings, const CellStep& step);

/// True only when no point of the cell has a level of at most L. Needs the upward mode.
[[nodiscard]] bool is_outside(const LockSet& set, const LevelCell& cell);

/// Lower and upper bound on the level in the part of the cell that lies in the set. Needs the upward mode.
[[nodiscard]] rigor::Interval levels_in(const LockSet& set, const LevelCell& cell);

}  // namespace veritrack::quadrature
