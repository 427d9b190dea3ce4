// The plain tracker's step, linearised by differences: part of falsifier.hpp.
#pragma once

#include <Eigen/Core>

#include "analysis/quadrature/falsifier/falsifier_run.hpp"

namespace veritrack::quadrature {

using Vector9 = Eigen::Matrix<double, 9, 1>;    ///< errors (3), then the covariance by its upper triangle
using Vector12 = Eigen::Matrix<double, 12, 1>;  ///< a state and an input (noise along and across, slew)

[[nodiscard]] PolarState state_of(const Vector9& x);
[[nodiscard]] Vector9 vector_of(const PolarState& s);

/// The state after a step of the claim's design.
[[nodiscard]] Vector9 next_state(const SetClaim& claim, const Vector12& x);

/// The gradient of weight' X(k+1) with respect to (X(k), input), by central differences.
[[nodiscard]] Vector12 pulled_back(const SetClaim& claim, const Vector9& weight, const PolarState& state,
                                   const Eigen::Vector3d& input);

/// rad/sample: of the fastest oscillation of the loop about zero error, in the state that it comes to after
/// `steps` steps.
[[nodiscard]] double own_frequency(const SetClaim& claim, int steps);

}  // namespace veritrack::quadrature
