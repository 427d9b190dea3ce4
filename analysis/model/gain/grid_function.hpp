// Functions of the phase and the frequency on a grid (docs/gain-proof.md, section 10).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/rigor/ball_model.hpp"

namespace veritrack::model {

/// A function with several components, nearly linear between the points of a grid of phases, and between the
/// lowest and the highest frequency of a part.
struct GridFunction {
  std::array<std::vector<std::vector<double>>, 2>
      values;                 ///< by end of the part, component, point of the grid
  std::vector<double> error;  ///< by component: the distance from it
  // Suprema by component: of it, and of its differences along the phase.
  std::vector<double> largest, first_difference, second_difference;
  /// Suprema of half of its change over the part, and of the differences of that along the phase.
  std::vector<double> lean, lean_difference;
};

/// The model of a component over a cell of phases: s goes from one point of the grid to the next.
using ModelAt = std::function<const rigor::BallModel&(std::size_t cell, std::size_t component)>;

/// From models of s and z over each cell. Where nothing is known, the error is NaN. Needs the upward rounding
/// mode.
[[nodiscard]] GridFunction grid_function(std::size_t components, std::size_t phases, const ModelAt& at);

/// The same as a function of the phase alone: that in the middle of the part, with a larger error. Needs the
/// upward rounding mode.
[[nodiscard]] GridFunction without_lean(const GridFunction& f);

/// sup |f - (constant + slope z)| over a cell; NaN where nothing is known. Needs the upward rounding mode.
[[nodiscard]] double distance_from_line(const rigor::BallModel& f, double constant, double slope);

}  // namespace veritrack::model
