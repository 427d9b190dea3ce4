// Does a step keep the covariance between its bounds around the steady state? With a leak.
#pragma once

#include <array>
#include <vector>

#include "analysis/quadrature/leak/steady_cell.hpp"

namespace veritrack::quadrature {

/// Bounds on the covariances after the steps of a cell.
struct SteadyOrder {
  bool kept = false;
  bool hopeless = false;  ///< not even at the middle: smaller cells will not help
  /// How much narrower the images would be known in a cell that is smaller in x, y: for the choice only.
  std::array<double, 2> blur{};
};

/// Are the images of both bounds on the covariance within `share` s of them, for every state of a cell at
/// level s? `step` is the step over the cell, `corners` its corner_offsets, `box` its offset_box,
/// `tangent_reach` as of SteadyBounds. Needs the upward mode.
[[nodiscard]] SteadyOrder keeps_covariance(const SteadySettings& settings,
                                           const std::vector<SteadyOffset>& corners, const SteadyOffset& box,
                                           const SteadyStep<SteadySecant>& step, double level,
                                           const rigor::Interval& tangent_reach,
                                           const rigor::Interval& share);

}  // namespace veritrack::quadrature
