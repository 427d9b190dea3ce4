// Dynamics along a curve that are written down rather than computed from a tracker.
#pragma once

#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "analysis/model/steady_state/curve_dynamics.hpp"

namespace veritrack::test {

/// The same step x' = A x + B v + (second and third order) at each of 2 harmonics + 1 phases; the frequency
/// is the first state, and the curve does not change with it.
inline model::CurveDynamics constant_dynamics(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                              std::vector<Eigen::MatrixXd> second, int harmonics = 2) {
  const Eigen::Index n = a.rows();
  const model::PhaseGrid grid(harmonics);
  const Eigen::MatrixXd jacobians = a.reshaped().replicate(1, grid.size());
  model::CurveDynamics dynamics{
      model::Cocycle(grid, 0.3, jacobians, static_cast<int>(n)), {}, {}, {}, {}, {}, {}};
  const model::StepDerivatives step{a, b, std::move(second), Eigen::MatrixXd::Zero(n, n * n * n)};
  const auto count = static_cast<std::size_t>(grid.size());
  dynamics.step.assign(count, step);
  dynamics.gradient.assign(count, Eigen::RowVectorXd::Unit(n, 0));
  dynamics.hessian.assign(count, Eigen::MatrixXd::Zero(n, n));
  const Eigen::MatrixXd source = b * b.transpose();
  dynamics.noise_source = source.reshaped().replicate(1, grid.size());
  dynamics.slew = Eigen::MatrixXd::Zero(n, grid.size());
  dynamics.size = Eigen::VectorXd::Ones(n);
  return dynamics;
}

/// x' = a x + b v + bend x^2/2; without noise, drift zeta is taken off for a slew.
inline model::CurveDynamics scalar_dynamics(double a, double b, double bend, double drift = 0.0) {
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(2, 2);
  hessian(0, 0) = bend;
  model::CurveDynamics dynamics =
      constant_dynamics(Eigen::MatrixXd::Constant(1, 1, a), Eigen::MatrixXd::Constant(1, 1, b),
                        std::vector<Eigen::MatrixXd>(1, hessian));
  dynamics.slew.setConstant(drift);
  return dynamics;
}

}  // namespace veritrack::test
