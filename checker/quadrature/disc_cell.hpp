// Boxes that cover the unit disc.
#pragma once

#include <array>
#include <vector>

namespace veritrack::checker {

using Point = std::array<double, 2>;

/// A box of (x, y) and of frequencies, rad/sample.
struct DiscCell {
  Point low, high;
  double from, to;

  /// No point of the box is in the unit disc, for certain.
  [[nodiscard]] bool is_outside() const;
  /// Corners of a polygon that contains what the box has in the unit disc.
  [[nodiscard]] std::vector<Point> corners() const;
  /// The two halves: 0 and 1 along x and y, 2 along the frequencies.
  [[nodiscard]] std::array<DiscCell, 2> halves(std::size_t side) const;
};

}  // namespace veritrack::checker
