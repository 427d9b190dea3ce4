// The cells into which the states of a level and the frequencies are cut, and quantities of a step over them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "analysis/quadrature/leak/steady_step.hpp"
#include "analysis/rigor/secant.hpp"

namespace veritrack::quadrature {

/// The variables that quantities of a step depend on: x and y of SteadyPlace, where z lies across the steady
/// one as a share of its reach, and the frequency.
enum SteadyVariable : std::size_t { kX = 0, kY = 1, kAcross = 2, kFrequency = 3 };
using SteadySecant = rigor::Secant<4>;
/// How far the variables are from the centre. The slopes of a secant belong to one point x of the cell, f(x)
/// = f(c) + s(x) (x - c). A check on corners holds these slopes fixed and takes the offset as an extra
/// parameter, by which every entry of a matrix is moved alike: the matrix is then affine in the offset, so
/// that what is positive definite in all corners, for every slope that occurs, is so at the offset x - c.
using SteadyOffset = SteadySecant::Slopes;

/// The setting of a cell of frequencies: over all of it, and from its middle.
struct SteadySettings {
  SteadySetting<rigor::Interval> over_cell;
  SteadySetting<SteadySecant> secants;
  rigor::Interval frequencies;  ///< about the middle, rad/sample
};

/// A box of (x, y).
struct SteadyCell {
  struct Point {
    double x, y;
  };
  std::array<double, 2> low, high;
  [[nodiscard]] double middle(std::size_t i) const { return low[i] + 0.5 * (high[i] - low[i]); }
  [[nodiscard]] double width(std::size_t i) const { return high[i] - low[i]; }
  [[nodiscard]] rigor::Interval side(std::size_t i) const {
    return rigor::Interval::from_bounds(low[i], high[i]);
  }
  /// No point of the cell lies in the unit disc. Needs the upward mode.
  [[nodiscard]] bool is_outside() const;
  /// Corners of a polygon inside the cell that holds all of the cell that lies in the unit disc: corners of
  /// the cell outside the disc are cut off along a line that the disc does not cross. Needs the upward mode.
  [[nodiscard]] std::vector<Point> corners() const;
};

/// Where the corners of the cell lie from its middle, at both ends of the frequencies; zero in kAcross. Needs
/// the upward mode.
[[nodiscard]] std::vector<SteadyOffset> corner_offsets(const SteadyCell& cell,
                                                       const rigor::Interval& frequencies);

/// All offsets of the cell as a box; across from -1 to 1. Needs the upward mode.
[[nodiscard]] SteadyOffset offset_box(const SteadyCell& cell, const rigor::Interval& frequencies);

/// The six entries moved by the offset.
[[nodiscard]] inline Symmetric<rigor::Interval> moved_by(const Symmetric<SteadySecant>& p,
                                                         const SteadyOffset& offset) {
  return {p.p11.moved_by(offset), p.p12.moved_by(offset), p.p13.moved_by(offset),
          p.p22.moved_by(offset), p.p23.moved_by(offset), p.p33.moved_by(offset)};
}

}  // namespace veritrack::quadrature
