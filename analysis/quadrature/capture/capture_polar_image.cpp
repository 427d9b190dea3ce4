#include "analysis/quadrature/capture/capture_polar_image.hpp"

#include <cmath>

#include "analysis/rigor/derivatives.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"
#include "trackers/quadrature/quadrature_rotating_frame.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

/// The state in the polar frame, (T (e - origin), P11, P12, P13, P22, P23, P33), from a state X of the
/// rotating frame; the phase error in (-pi, pi).
struct ToPolarFrame {
  const rigor::Matrix<3>& metric;
  const rigor::IntervalVector<3>& origin;

  template <typename Scalar>
  Eigen::Matrix<Scalar, kStateSize, 1> operator()(const Eigen::Matrix<Scalar, kStateSize, 1>& state) const {
    using trackers::PolarCovariance;
    const Scalar z1 = Scalar(1.0) + state[trackers::kDeltaInPhase];
    const Scalar& z2 = state[trackers::kDeltaQuadrature];
    const Scalar length = sqrt(square(z1) + square(z2));
    Eigen::Matrix<Scalar, 3, 1> error;
    error[0] = length - Scalar(1.0) - Scalar(origin[0]);
    error[1] = atan2(z2, z1) - Scalar(origin[1]);
    error[2] = state[trackers::kFrequencyError] - Scalar(origin[2]);
    const PolarCovariance<Scalar> p = trackers::turned(
        PolarCovariance<Scalar>{state[trackers::kP11], state[trackers::kP12], state[trackers::kP13],
                                state[trackers::kP22], state[trackers::kP23], state[trackers::kP33]},
        Scalar(-(z2 / length)), Scalar(z1 / length));
    Eigen::Matrix<Scalar, kStateSize, 1> result;
    for (int i = 0; i < 3; ++i) {
      result[i] = Scalar(Interval(metric(i, 0))) * error[0] + Scalar(Interval(metric(i, 1))) * error[1] +
                  Scalar(Interval(metric(i, 2))) * error[2];
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

}  // namespace

PolarImage polar_image(const rigor::Matrix<3>& metric, const rigor::IntervalVector<3>& origin,
                       const StateEnclosure& states) {
  const StateBox polar = image(ToPolarFrame{metric, origin}, states);
  PolarImage result;
  result.norm = sqrt(square(polar[0]) + square(polar[1]) + square(polar[2]));
  result.covariance << polar[3], polar[4], polar[5], polar[4], polar[6], polar[7], polar[5], polar[7],
      polar[8];
  return result;
}

double metric_of_middle(const rigor::Matrix<3>& metric, const rigor::Vector<3>& origin,
                        const StateEnclosure& states) {
  const StateVector& x = states.center;
  const rigor::Vector<3> error(std::hypot(1.0 + x[0], x[1]) - 1.0, std::atan2(x[1], 1.0 + x[0]), x[2]);
  return (metric * (error - origin)).norm();
}

}  // namespace veritrack::quadrature
