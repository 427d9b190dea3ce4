// One run of the plain tracker against a certified set: part of falsifier.hpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/quadrature/falsifier/falsifier.hpp"
#include "analysis/quadrature/leak/steady_set.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::quadrature {

using PolarState = trackers::PolarFrameState<double>;

/// A claim in floating point: the set with what follows from it. With a leak it is that of a SteadySet at one
/// constant frequency, which is a set around the steady state there; without, the centre is zero.
class SetClaim {
 public:
  /// Without a leak. Throws std::invalid_argument when the set is not one.
  SetClaim(const CertifiedSet& set, const trackers::ToneModel<double>& design);
  /// With a leak, at this frequency (rad/sample) and for slew zero; `steady` is the steady state there, to
  /// rounding. Throws as above.
  SetClaim(const SteadySet& set, const trackers::ToneModel<double>& design, const PolarState& steady,
           double frequency);

  /// With a leak: {|T (e - centre)| <= 1} x {P* - below <= P <= P* + above}, rates and gains without meaning.
  [[nodiscard]] const CertifiedSet& set() const { return set_; }
  [[nodiscard]] const Eigen::Vector3d& center() const { return center_; }
  [[nodiscard]] double frequency() const { return frequency_; }
  [[nodiscard]] const trackers::ToneModel<double>& design() const { return design_; }
  [[nodiscard]] const Eigen::Matrix3d& inverse_metric() const { return inverse_metric_; }
  [[nodiscard]] double level(const Eigen::Vector3d& error) const {
    return (set_.metric * (error - center_)).norm();
  }
  /// Bounds on |frequency error - that of the centre|, rad/sample: that of the set, and that of starts at the
  /// centre.
  [[nodiscard]] double bound_from_rim() const { return bound_from_rim_; }
  [[nodiscard]] double bound_from_zero() const { return bound_from_zero_; }
  /// P_lo + C Y C', C C' = P_hi - P_lo: a member for every 0 <= Y <= I. Starts at the centre are of the last
  /// level of a set with a leak.
  [[nodiscard]] Eigen::Matrix3d covariance_at(const Eigen::Matrix3d& share, bool at_center = false) const;
  /// The share Y, 0 <= Y <= I, for which <Lambda, covariance_at(Y)> is largest.
  [[nodiscard]] Eigen::Matrix3d share_along(const Eigen::Matrix3d& lambda) const;
  /// The claim that a step contradicts, with the numbers; nothing when it contradicts none. `input` is (noise
  /// along, noise across, slew).
  [[nodiscard]] std::optional<std::string> broken_by(const PolarState& before, const Eigen::Vector3d& input,
                                                     const PolarState& after) const;

 private:
  /// The members that follow from the set; the bounds apart.
  void complete(bool fits);
  /// Is P between the bounds of the level `share`, with this room (relative) beyond them?
  [[nodiscard]] bool covariance_is_inside(const Eigen::Matrix3d& covariance, double share, double room) const;

  CertifiedSet set_;
  trackers::ToneModel<double> design_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d center_covariance_ = Eigen::Matrix3d::Zero();
  double frequency_ = 0.7;      ///< without a leak it does not matter; this one is as good as any
  std::vector<double> levels_;  ///< with a leak
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

/// The outcome of a run.
struct RunOutcome {
  Attack attack;  ///< with the inputs that were used
  double frequency_error = 0.0;
  int step = 0;
  double largest_level = 0.0;  ///< |T e| / R, after the start
  std::optional<Alarm> alarm;
  std::vector<PolarState> states;  ///< k = 0 to the end
};

/// Runs QuadratureEkf<double> for `steps` steps beside a signal of amplitude 1 and compares every step with
/// the claim; ends early with an alarm. A start with an amplitude error of -1 or less, which no estimate has,
/// gives an empty outcome. Needs round to nearest.
[[nodiscard]] RunOutcome run_tracker(const SetClaim& claim, const Attack& start, const InputPolicy& policy,
                                     int steps);

/// As try_to_break of falsifier.hpp, where the centre takes the place of zero. With a leak the certified set
/// is a SteadySet: each step maps into the next level.
[[nodiscard]] Falsification try_to_break(const SetClaim& claim, const FalsifierOptions& options = {});

}  // namespace veritrack::quadrature
