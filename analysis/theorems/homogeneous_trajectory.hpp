// The homogeneous equation (2.34) of Theorem 2.8, z(k+1) = [I - K_zbar(k+1) H] F_x(k) z(k), zbar = x - z,
// whose gain is evaluated along x - z. Each step is enclosed separately, from the doubles it starts from.
//
// z is tiny (the theorem's ball has a radius of 1e-10 and less) and shrinks; it is kept as a direction of
// moderate size and a power of two, so that nothing underflows.
#pragma once

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace veritrack::theorems {

/// z(k) = 2^exponent direction, and P_zbar(k|k).
struct HomogeneousState {
  Eigen::Vector3d direction;
  int exponent = 0;
  trackers::FactoredCovariance<double> covariance;
};

/// The result of a step of (2.34), per unit of z.
struct HomogeneousStep {
  HomogeneousState next;              ///< rounded
  rigor::Interval relative_decrease;  ///< (V(k, z(k)) - V(k+1, z(k+1))) / |z(k)|^2, V = z' P_zbar(k|k)^-1 z
};

/// z(0) of the given length along `direction`, with P_zbar(0|0) = covariance. A direction that is zero or not
/// finite is replaced by (1, 1, 1).
[[nodiscard]] HomogeneousState start_homogeneous(const Eigen::Vector3d& direction, double length,
                                                 const Eigen::Matrix3d& covariance);

/// One step, at the true state x(k). Needs the upward rounding mode. The enclosure is empty, and the next
/// state NaN, when something was not finite.
[[nodiscard]] HomogeneousStep step_homogeneous(const HomogeneousState& state,
                                               const Eigen::Vector3d& true_state,
                                               const trackers::ToneModel<rigor::Interval>& design);

/// |z|. Needs the upward rounding mode.
[[nodiscard]] rigor::Interval magnitude_of(const HomogeneousState& state);

}  // namespace veritrack::theorems
