// One run of the plain tracker against a certified set: part of falsifier.hpp.
#pragma once

#include <functional>

#include "analysis/contraction/falsifier.hpp"
#include "trackers/quadrature_polar_frame.hpp"

namespace veritrack::contraction {

using PolarState = trackers::PolarFrameState<double>;

/// A claim in floating point: the set with what follows from it.
class Claim {
 public:
  /// Throws std::invalid_argument when the set is not one.
  Claim(const CertifiedSet& set, const trackers::QuadratureEkfDesign<double>& design);

  [[nodiscard]] const CertifiedSet& set() const { return set_; }
  [[nodiscard]] const trackers::QuadratureEkfDesign<double>& design() const { return design_; }
  [[nodiscard]] const Eigen::Matrix3d& inverse_metric() const { return inverse_metric_; }
  [[nodiscard]] double level(const Eigen::Vector3d& error) const { return (set_.metric * error).norm(); }
  /// Bounds on |frequency error|, rad/sample: that of the set, and that of starts at zero.
  [[nodiscard]] double bound_from_rim() const { return bound_from_rim_; }
  [[nodiscard]] double bound_from_zero() const { return bound_from_zero_; }
  /// P_lo + C Y C', C C' = P_hi - P_lo: a member for every 0 <= Y <= I.
  [[nodiscard]] Eigen::Matrix3d covariance_at(const Eigen::Matrix3d& share) const;
  [[nodiscard]] const Eigen::Matrix3d& covariance_root() const { return root_; }
  /// Is 0 <= Y <= I, up to rounding?
  [[nodiscard]] bool covariance_is_inside(const Eigen::Matrix3d& covariance) const;

 private:
  CertifiedSet set_;
  trackers::QuadratureEkfDesign<double> design_;
  Eigen::Matrix3d inverse_metric_;
  Eigen::Matrix3d root_;
  Eigen::Matrix3d inverse_root_;
  double bound_from_rim_ = 0.0;
  double bound_from_zero_ = 0.0;
};

[[nodiscard]] inline Eigen::Vector3d as_vector(const trackers::PolarError<double>& error) {
  return {error.amplitude, error.phase, error.frequency};
}

/// (noise along, noise across, slew) of step k, from the state at k.
using InputPolicy = std::function<Eigen::Vector3d(int k, const PolarState& state)>;

/// What a run came to.
struct RunOutcome {
  Attack attack;  ///< with the inputs that were used
  double frequency_error = 0.0;
  int step = 0;
  double largest_level = 0.0;  ///< |T e| / R, after the start
  std::optional<Alarm> alarm;
  std::vector<PolarState> states;  ///< k = 0 to the end
};

/// Runs QuadratureEkf<double> for `steps` steps beside a signal of amplitude 1 and holds every step against
/// the claim; ends early with an alarm. A start with an amplitude error of -1 or less, which no estimate
/// has, gives an empty outcome. Needs round to nearest.
[[nodiscard]] RunOutcome run_tracker(const Claim& claim, const Attack& start, const InputPolicy& policy,
                                     int steps);

}  // namespace veritrack::contraction
