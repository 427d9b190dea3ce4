// Numbers with which Coq proves that the filter's steady state lies between two matrices: a proposal for
// certificates/coq/ekf/steady.v.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "analysis/quadrature/true_phase/cell_forms.hpp"

namespace veritrack::quadrature {

/// The record steady_numbers of steady.v.
struct SteadyBounds {
  Eigen::Matrix<double, 3, 2> gain_above, gain_beneath;  ///< near the filter's at the two matrices
  double least_share = 0.0;  ///< this much of the lower matrix is below the image of 0
  double least_size = 0.0;   ///< this much of 1 is below the upper matrix
};

/// None where a step at zero errors does not make the upper matrix smaller and the lower one larger. Needs
/// the upward mode.
[[nodiscard]] std::optional<SteadyBounds> steady_bounds(const trackers::ToneModel<double>& design,
                                                        const Eigen::Matrix3d& lowest,
                                                        const Eigen::Matrix3d& highest);

}  // namespace veritrack::quadrature
