#include "analysis/quadrature/falsifier/falsifier_gradient.hpp"
#include "analysis/rigor/spectral_radius.hpp"

#include <algorithm>
#include <cmath>

namespace veritrack::quadrature {

PolarState state_of(const Vector9& x) {
  return {{x[0], x[1], x[2]}, {x[3], x[4], x[5], x[6], x[7], x[8]}};
}

Vector9 vector_of(const PolarState& s) {
  Vector9 x;
  x << s.error.amplitude, s.error.phase, s.error.frequency, s.covariance.p11, s.covariance.p12,
      s.covariance.p13, s.covariance.p22, s.covariance.p23, s.covariance.p33;
  return x;
}

Vector9 next_state(const SetClaim& claim, const Vector12& x) {
  const trackers::PolarInput<double> input{x[9], x[10], x[11], claim.frequency()};
  return vector_of(trackers::polar_frame_map<double>(state_of(x.head<9>()), input, claim.design()));
}

Vector12 pulled_back(const SetClaim& claim, const Vector9& weight, const PolarState& state,
                     const Eigen::Vector3d& input) {
  Vector12 x;
  x << vector_of(state), input;
  const auto& p = state.covariance;
  Vector12 step;
  step << 1e-5, 1e-5, 1e-5, p.p11, std::sqrt(p.p11 * p.p22), std::sqrt(p.p11 * p.p33), p.p22,
      std::sqrt(p.p22 * p.p33), p.p33, 1e-5, 1e-5, 1e-5;
  step.segment<6>(3) *= 1e-5;
  Vector12 gradient;
  for (int i = 0; i < 12; ++i) {
    Vector12 above = x;
    Vector12 below = x;
    above[i] += step[i];
    below[i] -= step[i];
    gradient[i] = weight.dot(next_state(claim, above) - next_state(claim, below)) / (2.0 * step[i]);
  }
  return gradient;
}

double own_frequency(const SetClaim& claim, int steps) {
  Vector12 x = Vector12::Zero();
  x.head<9>() = vector_of({{claim.center()[0], claim.center()[1], claim.center()[2]},
                           trackers::PolarCovariance<double>::from_matrix(
                               claim.covariance_at(0.5 * Eigen::Matrix3d::Identity()))});
  for (int k = 0; k < steps; ++k) {
    x.head<9>() = next_state(claim, x);
  }
  Eigen::Matrix3d loop;
  for (int i = 0; i < 3; ++i) {
    loop.row(i) = pulled_back(claim, Vector9::Unit(i), state_of(x.head<9>()), Eigen::Vector3d::Zero())
                      .head<3>()
                      .transpose();
  }
  return rigor::largest_argument(loop);
}

}  // namespace veritrack::quadrature
