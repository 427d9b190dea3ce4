// Random designs and estimates over many decades.
#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace veritrack::test {

/// 10^t with t uniform in [low, high).
inline double random_power(Random& random, double low, double high) {
  return std::pow(10.0, random.uniform(low, high));
}

/// q1, q2, r over five decades; a quarter without leak, a quarter without q1.
inline trackers::ToneModel<double> random_design(Random& random) {
  return {random.below(4) == 0 ? 0.0 : random_power(random, -5.0, 0.0), random_power(random, -5.0, 0.0),
          random_power(random, -4.0, 1.0), random.below(4) == 0 ? 0.0 : random.uniform(0.0, 0.2)};
}

/// D C D with a correlation-like C, well inside the definite matrices, and D over two decades.
inline Eigen::Matrix3d random_covariance(Random& random) {
  Eigen::Matrix3d a;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      a(i, j) = random.uniform(-1.0, 1.0);
    }
  }
  Eigen::Vector3d scale;
  for (int i = 0; i < 3; ++i) {
    scale(i) = random_power(random, -2.0, 0.0);
  }
  const Eigen::Matrix3d core = a * a.transpose() + 0.1 * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d p = scale.asDiagonal() * core * scale.asDiagonal();
  return 0.5 * (p + p.transpose());
}

inline trackers::QuadratureEstimate<double> random_estimate(Random& random) {
  const double in_phase = random.uniform(-1.5, 1.5);
  const double quadrature = random.uniform(-1.5, 1.5);
  const double frequency = random.uniform(-3.2, 3.2);
  return {in_phase, quadrature, frequency,
          trackers::FactoredCovariance<double>::from_matrix(random_covariance(random))};
}

}  // namespace veritrack::test
