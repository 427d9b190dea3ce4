// A simulated run of the quadrature tracker, for an audit.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace veritrack::theorems {

/// The record of step k. States are (in-phase, quadrature, frequency): signal units, signal units,
/// rad/sample. Doubles are exact: an audit refers to exactly these numbers.
struct TrajectoryRecord {
  Eigen::Vector3d true_state;            ///< x(k)
  Eigen::Vector2d measurement;           ///< y(k), signal units; not used for k = 0
  Eigen::Vector3d filtered_state;        ///< xhat(k|k)
  Eigen::Matrix3d filtered_covariance;   ///< P(k|k)
  Eigen::Matrix3d predicted_covariance;  ///< P(k+1|k)
};

/// Record k is step k; step 0 is the start.
using Trajectory = std::vector<TrajectoryRecord>;

}  // namespace veritrack::theorems
