#include "analysis/model/steady_state/cocycle.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {
namespace {

/// T(phi) = rotation by phi times a shear: A(phi) = T(phi + omega) L T(phi)^-1 has known products.
Eigen::Matrix2d frame(double phase) {
  Eigen::Matrix2d turn;
  turn << std::cos(phase), -std::sin(phase), std::sin(phase), std::cos(phase);
  Eigen::Matrix2d shear;
  shear << 1.0, 0.3 * std::cos(2.0 * phase), 0.0, 2.0;
  return turn * shear;
}

TEST_CASE("the grid interpolates trigonometric polynomials exactly, and cuts harmonics off") {
  const rigor::NearestRounding nearest;
  const PhaseGrid grid(5);
  const auto f = [](double phase) { return 2.0 + std::cos(3.0 * phase) - 0.5 * std::sin(5.0 * phase); };
  Eigen::MatrixXd values(1, grid.size());
  for (int j = 0; j < grid.size(); ++j) {
    values(0, j) = f(grid.phase(j));
  }
  const Eigen::MatrixXd later = values * grid.shift(0.7);
  const Eigen::MatrixXd low = values * grid.shift(0.7, 4);
  const Eigen::MatrixXcd harmonics = harmonics_of(values, 5);
  for (int j = 0; j < grid.size(); ++j) {
    const double phase = grid.phase(j) + 0.7;
    CHECK(later(0, j) == doctest::Approx(f(phase)).epsilon(1e-13));
    CHECK(low(0, j) == doctest::Approx(2.0 + std::cos(3.0 * phase)).epsilon(1e-13));
    CHECK(value_at(harmonics, phase)[0] == doctest::Approx(f(phase)).epsilon(1e-13));
  }
}

TEST_CASE("sums along the orbit of a reducible cocycle") {
  const rigor::NearestRounding nearest;
  const double omega = 0.7;
  const PhaseGrid grid(14);
  const Eigen::Matrix2d l = Eigen::Vector2d(0.95, -0.6).asDiagonal();
  Eigen::MatrixXd jacobians(4, grid.size());
  Eigen::MatrixXd noise(2, grid.size());
  Eigen::MatrixXd source(4, grid.size());
  for (int j = 0; j < grid.size(); ++j) {
    const Eigen::Matrix2d next = frame(grid.phase(j) + omega);
    const Eigen::Matrix2d a = next * l * frame(grid.phase(j)).inverse();
    jacobians.col(j) = a.reshaped();
    // In the frame: x+ = L x + (1, 1), P+ = L P L/lambda + identity.
    noise.col(j) = next * Eigen::Vector2d::Ones();
    const Eigen::Matrix2d square = next * next.transpose();
    source.col(j) = square.reshaped();
  }
  const Cocycle cocycle(grid, omega, jacobians, 2);
  CHECK(cocycle.rate() == doctest::Approx(0.95).epsilon(1e-4));
  const double lambda = 0.93;
  const Eigen::MatrixXd x = cocycle.bounded_solution(noise);
  const Eigen::MatrixXd pi = cocycle.lyapunov_solution(lambda, source);
  const Eigen::Vector2d steady(1.0 / 0.05, 1.0 / 1.6);
  const Eigen::Matrix2d steady_pi =
      Eigen::Vector2d(1.0 / (1.0 - 0.95 * 0.95 / lambda), 1.0 / (1.0 - 0.36 / lambda)).asDiagonal();
  for (int j = 0; j < grid.size(); ++j) {
    const Eigen::Matrix2d t = frame(grid.phase(j));
    CHECK((x.col(j) - t * steady).norm() < 1e-9 * steady.norm());
    const Eigen::Matrix2d expected = t * steady_pi * t.transpose();
    CHECK((pi.col(j).reshaped(2, 2) - expected).norm() < 1e-8 * expected.norm());
  }
}

TEST_CASE("a cocycle that grows says so") {
  const rigor::NearestRounding nearest;
  const PhaseGrid grid(3);
  const Eigen::MatrixXd jacobians = Eigen::MatrixXd::Constant(1, grid.size(), 1.01);
  CHECK(Cocycle(grid, 1.0, jacobians, 1).rate() > 1.009);
}

}  // namespace
}  // namespace veritrack::model
