#include "analysis/quadrature/falsifier/falsifier_run.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/symmetric_eigensystem.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

// Room for the rounding errors of the tracker and of the checks. A statement that is false by less than this
// would not be noticed.
constexpr double kRelativeRoom = 1e-9;
constexpr double kAbsoluteRoom = 1e-12;
constexpr double kCovarianceRoom = 1e-7;  // relative to P_hi - P_lo

double square(double x) {
  return x * x;
}

/// By leading minors.
bool is_definite(const Eigen::Matrix3d& m) {
  return m(0, 0) > 0.0 && m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1) > 0.0 && m.determinant() > 0.0;
}

std::string violation(const char* what, double found, double certified) {
  std::ostringstream text;
  text.precision(12);
  text << what << ": " << found << " was found where " << certified << " is certified";
  return text.str();
}

}  // namespace

SetClaim::SetClaim(const CertifiedSet& set, const trackers::ToneModel<double>& design)
    : set_(set), design_(design) {
  {
    const rigor::UpwardRounding upward;
    const Interval ultimate = ultimate_level(set, Interval(set.noise), Interval(set.slew));
    bound_from_rim_ = error_bounds(set, Interval(set.radius))[2].upper();
    bound_from_zero_ = error_bounds(set, ultimate)[2].upper();
  }
  complete(design.without_leak());
}

SetClaim::SetClaim(const SteadySet& set, const trackers::ToneModel<double>& design, const PolarState& steady,
                   double frequency)
    : design_(design),
      center_(as_vector(steady.error)),
      center_covariance_(steady.covariance.matrix()),
      frequency_(frequency),
      levels_(set.levels) {
  set_.metric = set.metric;
  set_.radius = 1.0;
  set_.covariance_lower = center_covariance_ - set.below;
  set_.covariance_upper = center_covariance_ + set.above;
  set_.noise = set.noise;
  if (!levels_.empty()) {
    const rigor::UpwardRounding upward;
    bound_from_rim_ = error_bounds(set, Interval(1.0))[2].upper();
    bound_from_zero_ = error_bounds(set, Interval(levels_.back()))[2].upper();
  }
  complete(!levels_.empty() && std::isfinite(frequency));
}

void SetClaim::complete(bool fits) {
  const Eigen::LLT<Eigen::Matrix3d> factor(set_.covariance_upper - set_.covariance_lower);
  inverse_metric_ = set_.metric.inverse();
  root_ = factor.matrixL();
  inverse_root_ = root_.inverse();
  const bool is_set = fits && factor.info() == Eigen::Success && inverse_metric_.allFinite() &&
                      inverse_root_.allFinite() && set_.covariance_lower.allFinite() && set_.radius > 0.0 &&
                      set_.noise >= 0.0 && set_.slew >= 0.0 && std::isfinite(bound_from_rim_) &&
                      std::isfinite(bound_from_zero_) && center_.allFinite();
  if (!is_set) {
    throw std::invalid_argument("the set to be falsified is not a certified set for this design");
  }
}

Eigen::Matrix3d SetClaim::covariance_at(const Eigen::Matrix3d& share, bool at_center) const {
  const Eigen::Matrix3d member = set_.covariance_lower + root_ * share * root_.transpose();
  const double level = at_center && !levels_.empty() ? levels_.back() : 1.0;
  return level < 1.0 ? Eigen::Matrix3d(center_covariance_ + level * (member - center_covariance_)) : member;
}

Eigen::Matrix3d SetClaim::share_along(const Eigen::Matrix3d& lambda) const {
  // The projection on the eigenvectors of C' Lambda C with positive eigenvalues.
  const rigor::Eigensystem eigen = rigor::symmetric_eigensystem(root_.transpose() * lambda * root_);
  Eigen::Matrix3d share = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (eigen.values[i] > 0.0) {
      share += eigen.vectors.col(i) * eigen.vectors.col(i).transpose();
    }
  }
  return share;
}

bool SetClaim::covariance_is_inside(const Eigen::Matrix3d& covariance, double share, double room) const {
  const Eigen::Matrix3d lower = center_covariance_ + share * (set_.covariance_lower - center_covariance_);
  const Eigen::Matrix3d y = inverse_root_ * (covariance - lower) * inverse_root_.transpose();
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  return is_definite(y + room * identity) && is_definite((share + room) * identity - y);
}

std::optional<std::string> SetClaim::broken_by(const PolarState& before, const Eigen::Vector3d& input,
                                               const PolarState& after) const {
  const double level_before = level(as_vector(before.error));
  const double level_after = level(as_vector(after.error));
  double share = 1.0;  // of the covariance bounds, that is certified after the step
  // Negated on purpose: NaN is an alarm too.
  if (levels_.empty()) {
    const double allowed = std::sqrt(square(set_.rate * level_before) +
                                     square(set_.noise_gain * std::hypot(input[0], input[1])) +
                                     square(set_.slew_gain * input[2]));
    if (!(level_after <= allowed * (1.0 + kRelativeRoom) + kAbsoluteRoom * set_.metric.norm())) {
      return violation("|T e+|^2 <= rate^2 |T e|^2 + L_v^2 |v|^2 + L_w^2 w^2", level_after, allowed);
    }
  } else {
    // From the last level that holds the state to the next one.
    std::size_t next = std::min<std::size_t>(1, levels_.size() - 1);
    while (next + 1 < levels_.size() && level_before <= levels_[next] * (1.0 - kRelativeRoom) &&
           covariance_is_inside(before.covariance.matrix(), levels_[next], -kCovarianceRoom)) {
      ++next;
    }
    share = levels_[next];
    if (!(level_after <= share * (1.0 + kRelativeRoom) + kAbsoluteRoom * set_.metric.norm())) {
      return violation("a step to the next level", level_after, share);
    }
  }
  if (!(level_after <= set_.radius * (1.0 + kRelativeRoom))) {
    return violation("|T e| <= R", level_after, set_.radius);
  }
  if (!covariance_is_inside(after.covariance.matrix(), share, kCovarianceRoom)) {
    return "P_lo <= P <= P_hi: the covariance has left its bounds";
  }
  return std::nullopt;
}

RunOutcome run_tracker(const SetClaim& claim, const Attack& start, const InputPolicy& policy, int steps) {
  RunOutcome outcome;
  outcome.attack = start;
  outcome.attack.inputs.clear();
  const double rho = 1.0 + start.start_error[0];
  if (!(rho > 0.0)) {
    return outcome;
  }
  double phase = 0.4;
  double frequency = claim.frequency();
  const double estimated = phase + start.start_error[1];
  const double sine = std::sin(estimated);
  const double cosine = std::cos(estimated);
  const trackers::QuadratureEstimate<double> own{
      rho, 0.0, frequency + start.start_error[2],
      trackers::FactoredCovariance<double>::from_matrix(start.start_covariance)};
  trackers::QuadratureEkf<double> tracker(claim.design(), trackers::turned(own, sine, cosine));
  outcome.states.push_back(trackers::to_polar_frame(tracker.filtered(), 1.0, phase, frequency));
  for (int k = 0; k < steps; ++k) {
    const PolarState before = outcome.states.back();
    const Eigen::Vector3d input = policy(k, before);
    outcome.attack.inputs.push_back(input);
    const double predicted_phase = phase + before.error.phase + (before.error.frequency + frequency);
    phase = std::remainder(phase + frequency, 2.0 * std::numbers::pi);
    frequency += input[2];
    const double c = std::cos(predicted_phase);
    const double s = std::sin(predicted_phase);
    tracker.step(std::cos(phase) + input[0] * c - input[1] * s,
                 std::sin(phase) + input[0] * s + input[1] * c);
    const PolarState after = trackers::to_polar_frame(tracker.filtered(), 1.0, phase, frequency);
    const std::optional<std::string> broken = claim.broken_by(before, input, after);
    if (broken) {
      outcome.alarm = Alarm{outcome.attack, *broken, k + 1};
    }
    outcome.states.push_back(after);
    outcome.largest_level =
        std::max(outcome.largest_level, claim.level(as_vector(after.error)) / claim.set().radius);
    const double deviation = std::abs(after.error.frequency - claim.center()[2]);
    if (!(deviation <= outcome.frequency_error)) {
      outcome.frequency_error = deviation;
      outcome.step = k + 1;
    }
    if (outcome.alarm) {
      break;
    }
  }
  return outcome;
}

}  // namespace veritrack::quadrature
