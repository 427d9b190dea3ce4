#include "analysis/model/steady_state/curve_dynamics.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/analysis/model/example_recursions.hpp"

namespace veritrack::model {
namespace {

TEST_CASE("along a curve: the derivatives of a loop at each phase, its noise, its drift and its sizes") {
  const test::ExampleTracker loop = test::phase_locked_loop();
  const double ki = loop.constants[0], kp = loop.constants[1];
  // w = 0.3 + 0.01 cos(2 phi) + 0.02 sin(2 phi), theta = phi + 0.1 - 0.05 sin(2 phi): no steady state.
  NodeCurve curve;
  curve.frequency = 0.3;
  curve.turns = {0, 1};
  curve.harmonics = Eigen::MatrixXcd::Zero(2, 3);
  curve.harmonics(0, 0) = 0.3;
  curve.harmonics(0, 2) = {0.01, -0.02};
  curve.harmonics(1, 0) = 0.1;
  curve.harmonics(1, 2) = {0.0, 0.05};
  Eigen::MatrixXcd slope = Eigen::MatrixXcd::Zero(2, 3);
  slope(0, 0) = 1.0;
  slope(1, 2) = 0.25;
  const PhaseGrid grid(8);
  const CurveDynamics dynamics = follow_curve(test::tone_of(loop), curve, slope, grid);
  REQUIRE(dynamics.step.size() == 17);
  double mean_square = 0.0;
  for (int j = 0; j < grid.size(); ++j) {
    CAPTURE(j);
    const double phase = grid.phase(j);
    const double w = 0.3 + 0.01 * std::cos(2.0 * phase) + 0.02 * std::sin(2.0 * phase);
    const double theta = phase + 0.1 - 0.05 * std::sin(2.0 * phase);
    const double y = std::cos(phase + 0.3);  // the sample is the next one
    mean_square += w * w / grid.size();
    const auto at = static_cast<std::size_t>(j);
    const Eigen::Matrix2d state{{1.0, -ki * y * std::cos(theta)}, {1.0, 1.0 - kp * y * std::cos(theta)}};
    CHECK((dynamics.step[at].state - state).norm() < 1e-12);
    CHECK((dynamics.cocycle.jacobian(j) - state).norm() < 1e-12);
    CHECK(dynamics.step[at].second[1](1, 1) == doctest::Approx(kp * y * std::sin(theta)).epsilon(1e-9));
    CHECK((dynamics.gradient[at] - Eigen::RowVector2d(1.0, 0.0)).norm() < 1e-15);
    CHECK(dynamics.hessian[at].norm() < 1e-15);
    const double sine = std::sin(theta);
    const Eigen::Vector4d noise(ki * ki, ki * kp, ki * kp, kp * kp);
    CHECK((dynamics.noise_source.col(j) - sine * sine * noise).norm() < 1e-12);
    // The drift is that of the next place.
    CHECK(std::fabs(dynamics.slew(0, j) - 1.0) < 1e-14);
    CHECK(std::fabs(dynamics.slew(1, j) - 0.25 * std::cos(2.0 * (phase + 0.3))) < 1e-13);
  }
  CHECK(dynamics.cocycle.frequency() == 0.3);
  CHECK(dynamics.size[0] == doctest::Approx(std::sqrt(mean_square)));
  CHECK(dynamics.size[1] == 1.0);  // an angle
}

}  // namespace
}  // namespace veritrack::model
