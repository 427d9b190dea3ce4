// An attempt to break the drift inequality of a lock set, with the textbook filter and the Gaussian integral.
// Proves nothing; a point where the inequality fails is an alarm.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "analysis/quadrature/gaussian/lock_set.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// A state in the frame of the true phase, amplitude 1.
struct DriftPoint {
  Eigen::Vector3d error;
  Eigen::Matrix3d covariance;
};

/// log E[W(k+1)] - log(kappa W(k) + c_0) from this state, by (2) of docs/gaussian.md and the textbook's
/// filter: not positive where the inequality is true, +infinity where the expected value is infinite. In
/// round-to-nearest.
[[nodiscard]] double drift_excess(const LockSet& set, const trackers::ToneModel<double>& design,
                                  const DriftPoint& point);

/// The result of the ascent.
struct DriftAttack {
  double closest = 0.0;  ///< the largest excess; below 0 for a PROVED set
  DriftPoint point;
  std::int64_t evaluations = 0;
};

/// Climbs the excess over all errors, levels and covariances of the set, from `starts` points drawn at
/// random. Deterministic. Opens its own NearestRounding scope. epsilon must be zero.
[[nodiscard]] DriftAttack attack_drift(const LockSet& set, const trackers::ToneModel<double>& design,
                                       int starts = 40);

}  // namespace veritrack::quadrature
