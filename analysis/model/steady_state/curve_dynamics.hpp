// The dynamics of a tracker next to its curve, to third order, in floating point.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/model/steady_state/cocycle.hpp"
#include "analysis/model/steady_state/curve_fit.hpp"

namespace veritrack::model {

/// A tracker along its curve at one frequency, on a grid of phases.
struct CurveDynamics {
  Cocycle cocycle;
  std::vector<StepDerivatives> step;         ///< at each phase
  std::vector<Eigen::RowVectorXd> gradient;  ///< of the estimated frequency at each phase
  std::vector<Eigen::MatrixXd> hessian;      ///< likewise
  Eigen::MatrixXd noise_source;              ///< B B', B by the samples: n^2 x grid.size()
  /// dC/domega at phase + omega: n x grid.size().
  Eigen::MatrixXd slew;
  Eigen::VectorXd size;  ///< of each state: the root of its mean square; of an angle, 1
};

/// `slope`: of the curve's harmonics by the frequency.
[[nodiscard]] CurveDynamics follow_curve(const TrackedTone& tone, const NodeCurve& curve,
                                         const Eigen::MatrixXcd& slope, const PhaseGrid& grid);

}  // namespace veritrack::model
