// Linear recursions along an orbit that turns by a constant angle a sample, solved by doubling.
//
// With A(phi) given on a grid of phases, the product over m samples Phi_m(phi) = A(phi + (m-1) omega) ...
// A(phi) satisfies Phi_2m(phi) = Phi_m(phi + m omega) Phi_m(phi); sums along the orbit double likewise. The
// values at phi + m omega are those of the trigonometric polynomial through the grid. So 2^14 samples cost 14
// steps.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/model/steady_state/phase_grid.hpp"

namespace veritrack::model {

/// x(phi + omega) = A(phi) x(phi) + ..., n states. A proposal's tool: in double, without any claim.
class Cocycle {
 public:
  /// `jacobians`: n^2 x grid.size(), column-major matrices A at the phases of the grid. `frequency` in
  /// rad/sample.
  Cocycle(const PhaseGrid& grid, double frequency, const Eigen::MatrixXd& jacobians, int states);

  /// The growth per sample; NaN when the products are not finite.
  [[nodiscard]] double rate() const { return rate_; }
  [[nodiscard]] const PhaseGrid& grid() const { return grid_; }
  [[nodiscard]] double frequency() const { return frequency_; }
  [[nodiscard]] int states() const { return states_; }
  [[nodiscard]] auto jacobian(int j) const {
    return Eigen::Map<const Eigen::MatrixXd>(jacobians_.col(j).data(), states_, states_);
  }

  /// x with x(phi + omega) = A(phi) x(phi) + source(phi): n x grid.size(). Needs a rate below 1.
  [[nodiscard]] Eigen::MatrixXd bounded_solution(const Eigen::MatrixXd& source) const;

  /// Pi with Pi(phi + omega) = A Pi A' / lambda + source(phi): n^2 x grid.size(), the source too. Needs
  /// lambda above the square of the rate.
  [[nodiscard]] Eigen::MatrixXd lyapunov_solution(double lambda, const Eigen::MatrixXd& source) const;

 private:
  PhaseGrid grid_;
  double frequency_;
  int states_;
  double rate_ = 1.0;
  Eigen::MatrixXd jacobians_;
  // For m = 2^k samples: the products at phi + m omega, divided by exp(logarithms_[k]), and the shift by m
  // omega.
  std::vector<Eigen::MatrixXd> later_;
  std::vector<double> logarithms_;
  std::vector<Eigen::MatrixXd> shifts_;
};

}  // namespace veritrack::model
