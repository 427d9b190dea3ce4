// Functions of the phase on a grid (docs/gain-proof.md, section 10).
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/rigor/ball_model.hpp"

namespace veritrack::model {

/// A function of the phase with several components, nearly linear between the points of a grid.
struct GridFunction {
  std::vector<std::vector<double>> values;  ///< by component, by point of the grid
  std::vector<double> error;                ///< by component: the distance from it, for all frequencies
  std::vector<double> largest, first_difference, second_difference;  ///< by component
};

/// The larger one; NaN where one of them is.
[[nodiscard]] inline double larger_or_nan(double a, double b) {
  return a >= b ? a : a < b ? b : NAN;
}

/// The model of a component over a cell of phases: s goes from one point of the grid to the next.
using ModelAt = std::function<const rigor::BallModel&(std::size_t cell, std::size_t component)>;

/// From models of s and z over each cell. Where nothing is known, the error is NaN. Needs the upward rounding
/// mode.
[[nodiscard]] GridFunction grid_function(std::size_t components, std::size_t phases, const ModelAt& at);

}  // namespace veritrack::model
