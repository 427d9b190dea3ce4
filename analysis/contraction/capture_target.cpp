#include "analysis/contraction/capture_target.hpp"

#include <cmath>

#include "analysis/rigor/definiteness.hpp"
#include "analysis/rigor/derivatives.hpp"
#include "trackers/quadrature_polar_frame.hpp"
#include "trackers/quadrature_rotating_frame.hpp"

namespace veritrack::contraction {

namespace {

using rigor::Interval;
using rigor::IntervalMatrix;

/// The state in the polar frame, (T e, P11, P12, P13, P22, P23, P33), from a state X of the rotating frame;
/// the phase error in (-pi, pi).
struct ToPolarFrame {
  const CertifiedSet& set;
  Interval frequency_shift;

  template <typename Scalar>
  Eigen::Matrix<Scalar, kStateSize, 1> operator()(const Eigen::Matrix<Scalar, kStateSize, 1>& state) const {
    using trackers::PolarCovariance;
    const Scalar z1 = Scalar(1.0) + state[trackers::kDeltaInPhase];
    const Scalar& z2 = state[trackers::kDeltaQuadrature];
    const Scalar length = sqrt(square(z1) + square(z2));
    Eigen::Matrix<Scalar, 3, 1> error;
    error[0] = length - Scalar(1.0);
    error[1] = atan2(z2, z1);
    error[2] = state[trackers::kFrequencyError] - Scalar(frequency_shift);
    const PolarCovariance<Scalar> p = trackers::turned(
        PolarCovariance<Scalar>{state[trackers::kP11], state[trackers::kP12], state[trackers::kP13],
                                state[trackers::kP22], state[trackers::kP23], state[trackers::kP33]},
        Scalar(-(z2 / length)), Scalar(z1 / length));
    Eigen::Matrix<Scalar, kStateSize, 1> result;
    for (int i = 0; i < 3; ++i) {
      result[i] = Scalar(Interval(set.metric(i, 0))) * error[0] +
                  Scalar(Interval(set.metric(i, 1))) * error[1] +
                  Scalar(Interval(set.metric(i, 2))) * error[2];
    }
    result[3] = p.p11;
    result[4] = p.p12;
    result[5] = p.p13;
    result[6] = p.p22;
    result[7] = p.p23;
    result[8] = p.p33;
    return result;
  }
};

/// f over all states of the enclosure, by the mean value theorem: f(center) + f'(hull) (x - center).
template <typename Function>
StateBox image(const Function& function, const StateEnclosure& states) {
  const StateBox center = rigor::to_interval(states.center);
  const StateBox at_center = function(center);
  const StateMatrix slope = rigor::jacobian(function, states.hull);
  const rigor::DynamicIntervalMatrix turned = slope * rigor::to_interval(states.generators);
  StateBox result;
  for (int i = 0; i < kStateSize; ++i) {
    Interval deviation(0.0);
    for (Eigen::Index j = 0; j < turned.cols(); ++j) {
      deviation += abs(turned(i, j));
    }
    for (int j = 0; j < kStateSize; ++j) {
      deviation += abs(slope(i, j)) * Interval(states.box[j]);
    }
    result[i] = is_finite(deviation) ? at_center[i] + rigor::symmetric(deviation.upper()) : Interval::empty();
  }
  return result;
}

/// A look at the middle, to spare the work above as long as it would be in vain; proves nothing.
bool worth_a_look(const CertifiedSet& set, const StateEnclosure& states, double shift) {
  const StateVector& x = states.center;
  const rigor::Vector<3> error(std::hypot(1.0 + x[0], x[1]) - 1.0, std::atan2(x[1], 1.0 + x[0]),
                               x[2] - shift);
  return (set.metric * error).norm() < set.radius;
}

}  // namespace

std::optional<Settled> CertifiedSetTarget::settled(const StateEnclosure& states) const {
  const double middle = states.center[trackers::kFrequencyError];
  const double turns = periodic_ ? std::nearbyint(middle / 6.283185307179586) : 0.0;
  if (!(std::fabs(turns) < 1e6) || !worth_a_look(set_, states, 6.283185307179586 * turns)) {
    return std::nullopt;
  }
  const Interval shift = Interval(2.0 * turns) * rigor::pi();
  const StateBox polar = image(ToPolarFrame{set_, shift}, states);
  if (!rigor::is_finite(polar)) {
    return std::nullopt;
  }
  const Interval norm = sqrt(square(polar[0]) + square(polar[1]) + square(polar[2]));
  IntervalMatrix<3> covariance;
  covariance << polar[3], polar[4], polar[5], polar[4], polar[6], polar[7], polar[5], polar[7], polar[8];
  const IntervalMatrix<3> above = covariance - rigor::to_interval(set_.covariance_lower);
  const IntervalMatrix<3> below = rigor::to_interval(set_.covariance_upper) - covariance;
  const bool inside = certainly_less_equal(norm, Interval(set_.radius)) &&
                      rigor::is_positive_definite(above) == rigor::Verdict::proved &&
                      rigor::is_positive_definite(below) == rigor::Verdict::proved;
  return inside ? std::optional(Settled{static_cast<int>(turns), norm.upper()}) : std::nullopt;
}

}  // namespace veritrack::contraction
