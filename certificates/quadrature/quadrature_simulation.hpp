// The simulated run of the quadrature tracker.
#pragma once

#include <Eigen/Core>

#include "certificates/design/design.hpp"
#include "certificates/sets/simulation.hpp"

namespace veritrack::certificates {

/// Runs the tracker from the edge of the assumed start errors (amplitude, phase and frequency each wrong by
/// the most that is allowed) along the signal that [simulate] names. Holds round-to-nearest: this is the
/// tracker as it runs.
[[nodiscard]] Simulation simulate_quadrature(const Design& design);

/// A covariance to start from, in the frame of the estimated phase.
struct SteadyState {
  Eigen::Matrix3d covariance;  ///< P(k|k), signal units and rad/sample
  bool settled = false;        ///< whether the filter came to rest within the steps that were tried
};

/// The covariance at which the noise-free tracker settles at a constant frequency (rad/sample), by iteration
/// in double: a floating-point proposal, not a proof. When the tracker does not settle, the covariance after
/// the last step of the iteration with the estimation error held at zero.
[[nodiscard]] SteadyState find_steady_state(const Design& design, double frequency);

/// P(0|0) of a run that starts at that frequency (rad/sample), in the frame of the estimated phase: as the
/// design gives it (for a range, its end), or the filter's steady state. Needs round-to-nearest.
[[nodiscard]] SteadyState run_start_covariance(const Design& design, double frequency);

/// The covariance in a frame that is turned by the angle, rad.
[[nodiscard]] Eigen::Matrix3d turned_covariance(const Eigen::Matrix3d& covariance, double angle);

}  // namespace veritrack::certificates
