// The tracker in double precision beside its twin in long double: what rounding does, without any analysis.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "analysis/quadrature/rounding/step_rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::test {

using Wide = long double;
using WideMatrix = Eigen::Matrix<Wide, 3, 3>;

template <typename To, typename From>
trackers::QuadratureEstimate<To> estimate_as(const trackers::QuadratureEstimate<From>& e) {
  const auto& p = e.covariance;
  const auto to = [](From x) { return static_cast<To>(x); };
  return {to(e.in_phase),
          to(e.quadrature),
          to(e.frequency),
          {to(p.conditional_11), to(p.conditional_12), to(p.conditional_22), to(p.regression_1),
           to(p.regression_2), to(p.frequency_variance)}};
}

/// A step in double, and the same from the very same numbers in long double.
struct Twins {
  trackers::QuadratureEstimate<double> computed;
  trackers::QuadratureEstimate<Wide> exact;
};
inline Twins twin_steps(const trackers::ToneModel<double>& design,
                        const trackers::QuadratureEstimate<double>& start, double in_phase,
                        double quadrature) {
  const trackers::ToneModel<Wide> same{design.q1, design.q2, design.r, design.epsilon};
  return {trackers::step(start, in_phase, quadrature, design).filtered,
          trackers::step(estimate_as<Wide>(start), static_cast<Wide>(in_phase), static_cast<Wide>(quadrature),
                         same)
              .filtered};
}

/// What the two differ by, in the terms of StateDifference.
inline quadrature::StateDifference difference_of(const Twins& twins) {
  const auto computed = estimate_as<Wide>(twins.computed);
  const WideMatrix d = computed.covariance.matrix() - twins.exact.covariance.matrix();
  const Eigen::Matrix<Wide, 2, 2> zz = d.topLeftCorner<2, 2>();
  return {static_cast<double>(std::hypot(computed.in_phase - twins.exact.in_phase,
                                         computed.quadrature - twins.exact.quadrature)),
          static_cast<double>(std::fabs(computed.frequency - twins.exact.frequency)),
          oracle::symmetric_eigenvalues(zz.cast<double>()).cwiseAbs().maxCoeff(),
          static_cast<double>(std::hypot(d(0, 2), d(1, 2))), static_cast<double>(std::fabs(d(2, 2)))};
}

/// The five ratios.
inline quadrature::StateDifference shares(const quadrature::StateDifference& found,
                                          const quadrature::StateDifference& bound) {
  return {found.z / bound.z, found.frequency / bound.frequency, found.p_zz / bound.p_zz,
          found.p_z3 / bound.p_z3, found.p_33 / bound.p_33};
}

/// diag(Rot(angle), 1).
inline Eigen::Matrix3d plane_turn(double angle) {
  Eigen::Matrix3d u = Eigen::Matrix3d::Identity();
  u.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return u;
}

/// A matrix between two others: low + D^(1/2) Y D^(1/2), 0 <= Y <= I, often at an end.
inline Eigen::Matrix3d between(Random& random, const Eigen::Matrix3d& low, const Eigen::Matrix3d& high) {
  Eigen::Matrix3d a;
  for (int i = 0; i < 9; ++i) {
    a(i) = random.uniform(-1.0, 1.0);
  }
  const Eigen::Matrix3d axes = oracle::orthogonal_factor(a);
  Eigen::Vector3d share;
  for (int i = 0; i < 3; ++i) {
    share[i] = random.below(2) == 0 ? static_cast<double>(random.below(2)) : random.uniform();
  }
  const Eigen::Matrix3d root = oracle::cholesky_factor(high - low);
  return low + root * axes * share.asDiagonal() * axes.transpose() * root.transpose();
}

using WidePolar = trackers::PolarFrameState<Wide>;

/// |T (e - f)| of two states of the same signal, in long double.
inline double distance(const Eigen::Matrix3d& metric, const WidePolar& a, const WidePolar& b) {
  const Eigen::Matrix<Wide, 3, 1> e(a.error.amplitude - b.error.amplitude, a.error.phase - b.error.phase,
                                    a.error.frequency - b.error.frequency);
  return static_cast<double>((metric.cast<Wide>() * e).norm());
}

/// The least m with -m P <= A - B <= m P.
inline double share_of_difference(const Eigen::Matrix3d& p, const WidePolar& a, const WidePolar& b) {
  const Eigen::Matrix3d d = (a.covariance.matrix() - b.covariance.matrix()).cast<double>();
  return oracle::relative_eigenvalues(0.5 * (d + d.transpose()), p).cwiseAbs().maxCoeff();
}

}  // namespace veritrack::test
