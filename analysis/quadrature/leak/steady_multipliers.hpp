// Multipliers for the inequality of a cell (steady_rate.hpp), proposed in floating point.
#pragma once

#include <Eigen/Core>

#include "analysis/quadrature/leak/steady_rate.hpp"

namespace veritrack::quadrature {

/// The steps of a cell, in double: those of its middle, with an image that is affine in (x, y).
struct SteadyCellReach {
  SteadyReach reach;                   ///< at the middle; hidden_squared does not matter
  Eigen::Matrix<double, 3, 2> slopes;  ///< of the image in x and y
  Eigen::Vector2d middle;              ///< of (x, y)
  double size_squared;                 ///< bound on |(x, y) - middle|^2
};

/// The least rate that one set of multipliers certifies for all of the cell, and these, moved to where a
/// `target` above it is certified with room to spare. A rate of infinity when none is found.
[[nodiscard]] SteadyRate propose_cell_rate(const SteadyCellReach& cell, double target_squared);

}  // namespace veritrack::quadrature
