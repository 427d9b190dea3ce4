#include "analysis/contraction/falsifier_run.hpp"

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

namespace veritrack::contraction {

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
bool is_positive_definite(const Eigen::Matrix3d& m) {
  return m(0, 0) > 0.0 && m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1) > 0.0 && m.determinant() > 0.0;
}

std::string told(const char* what, double found, double certified) {
  std::ostringstream text;
  text.precision(12);
  text << what << ": " << found << " was found where " << certified << " is certified";
  return text.str();
}

}  // namespace

Claim::Claim(const CertifiedSet& set, const trackers::QuadratureEkfDesign<double>& design)
    : set_(set), design_(design), inverse_metric_(set.metric.inverse()) {
  const Eigen::LLT<Eigen::Matrix3d> factor(set.covariance_upper - set.covariance_lower);
  root_ = factor.matrixL();
  inverse_root_ = root_.inverse();
  {
    const rigor::UpwardRounding upward;
    const Interval ultimate = ultimate_level(set, Interval(set.noise), Interval(set.slew));
    bound_from_rim_ = error_bounds(set, Interval(set.radius))[2].upper();
    bound_from_zero_ = error_bounds(set, ultimate)[2].upper();
  }
  const bool is_set = factor.info() == Eigen::Success && inverse_metric_.allFinite() &&
                      inverse_root_.allFinite() && set.covariance_lower.allFinite() && set.radius > 0.0 &&
                      set.noise >= 0.0 && set.slew >= 0.0 && std::isfinite(bound_from_rim_) &&
                      std::isfinite(bound_from_zero_) && design.epsilon == 0.0;
  if (!is_set) {
    throw std::invalid_argument("what is to be broken is not a certified set for epsilon = 0");
  }
}

Eigen::Matrix3d Claim::covariance_at(const Eigen::Matrix3d& share) const {
  return set_.covariance_lower + root_ * share * root_.transpose();
}

bool Claim::covariance_is_inside(const Eigen::Matrix3d& covariance) const {
  const Eigen::Matrix3d share =
      inverse_root_ * (covariance - set_.covariance_lower) * inverse_root_.transpose();
  const Eigen::Matrix3d room = kCovarianceRoom * Eigen::Matrix3d::Identity();
  return is_positive_definite(share + room) &&
         is_positive_definite(Eigen::Matrix3d::Identity() - share + room);
}

RunOutcome run_tracker(const Claim& claim, const Attack& start, const InputPolicy& policy, int steps) {
  RunOutcome outcome;
  outcome.attack = start;
  outcome.attack.inputs.clear();
  const double rho = 1.0 + start.start_error[0];
  if (!(rho > 0.0)) {
    return outcome;
  }
  // Without a leak the frequency does not matter; this one is as good as any.
  double phase = 0.4;
  double frequency = 0.7;
  const double estimated = phase + start.start_error[1];
  const double sine = std::sin(estimated);
  const double cosine = std::cos(estimated);
  const trackers::QuadratureEstimate<double> own{
      rho, 0.0, frequency + start.start_error[2],
      trackers::FactoredCovariance<double>::from_matrix(start.start_covariance)};
  trackers::QuadratureEkf<double> tracker(claim.design(), trackers::turned(own, sine, cosine));
  outcome.states.push_back(trackers::to_polar_frame(tracker.filtered(), 1.0, phase, frequency));
  const CertifiedSet& set = claim.set();
  const auto raise = [&](std::string statement, int k) {
    outcome.alarm = Alarm{outcome.attack, std::move(statement), k};
  };
  for (int k = 0; k < steps; ++k) {
    const PolarState& before = outcome.states.back();
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
    const double level_before = claim.level(as_vector(before.error));
    outcome.states.push_back(after);
    const Eigen::Vector3d error = as_vector(after.error);
    const double level = claim.level(error);
    const double allowed =
        std::sqrt(square(set.rate * level_before) + square(set.noise_gain * std::hypot(input[0], input[1])) +
                  square(set.slew_gain * input[2]));
    outcome.largest_level = std::max(outcome.largest_level, level / set.radius);
    if (!(std::abs(error[2]) <= outcome.frequency_error)) {
      outcome.frequency_error = std::abs(error[2]);
      outcome.step = k + 1;
    }
    // Negated on purpose: NaN is an alarm too.
    if (!(level <= allowed * (1.0 + kRelativeRoom) + kAbsoluteRoom * set.metric.norm())) {
      raise(told("|T e+|^2 <= rate^2 |T e|^2 + L_v^2 |v|^2 + L_w^2 w^2", level, allowed), k + 1);
    } else if (!(level <= set.radius * (1.0 + kRelativeRoom))) {
      raise(told("|T e| <= R", level, set.radius), k + 1);
    } else if (!claim.covariance_is_inside(after.covariance.matrix())) {
      raise("P_lo <= P <= P_hi: the covariance has left its bounds", k + 1);
    }
    if (outcome.alarm) {
      break;
    }
  }
  return outcome;
}

}  // namespace veritrack::contraction
