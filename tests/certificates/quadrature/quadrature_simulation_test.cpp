#include "certificates/quadrature/quadrature_simulation.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/certificates/test_design.hpp"
#include "tests/support/oracles.hpp"

namespace {

using namespace veritrack;

/// The textbook Riccati recursion in the rotating frame, at zero error: the oracle for the steady state
/// without leak.
Eigen::Matrix3d riccati_fixed_point(double q1, double q2, double r) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(1, 2) = 1.0;
  const Eigen::Matrix<double, 2, 3> h = Eigen::Matrix<double, 2, 3>::Identity();
  Eigen::Matrix3d p = Eigen::Matrix3d::Identity();
  for (int step = 0; step < 5000; ++step) {
    const Eigen::Matrix3d predicted =
        f * p * f.transpose() + Eigen::Vector3d(q1, q1, q2).asDiagonal().toDenseMatrix();
    const Eigen::Matrix2d s = h * predicted * h.transpose() + r * Eigen::Matrix2d::Identity();
    const Eigen::Matrix<double, 3, 2> gain = predicted * h.transpose() * s.inverse();
    p = predicted - gain * h * predicted;
  }
  return p;
}

TEST_CASE("the steady state is the fixed point of the textbook Riccati recursion") {
  const certificates::SteadyState steady = certificates::find_steady_state(test::design(), 1.0);
  CHECK(steady.settled);
  CHECK((steady.covariance - riccati_fixed_point(0.0023, 0.0023, 0.05)).norm() < 1e-12);
}

TEST_CASE("the steady state scales with the amplitude") {
  const auto design = test::design({{"amplitude = 1.0", "amplitude = 3.0"}});
  const certificates::SteadyState steady = certificates::find_steady_state(design, 1.0);
  const Eigen::Matrix3d unit = riccati_fixed_point(0.0023 / 9.0, 0.0023, 0.05 / 9.0);
  const Eigen::Vector3d scale(3.0, 3.0, 1.0);
  CHECK((steady.covariance - scale.asDiagonal() * unit * scale.asDiagonal()).norm() < 1e-12);
}

TEST_CASE("without noise on the amplitude there is no steady state, and the run says so") {
  const auto design = test::design({{"q1 = 0.0023", "q1 = 0"}});
  CHECK_FALSE(certificates::find_steady_state(design, 1.0).settled);
  CHECK(certificates::simulate_quadrature(design).notes.size() == 1);
}

TEST_CASE("the run starts at the edge of the assumed errors") {
  const certificates::Simulation simulation = certificates::simulate_quadrature(test::design());
  REQUIRE(simulation.trajectory.size() == 60);
  CHECK(simulation.notes.empty());
  const auto& start = simulation.trajectory.front();
  const auto size = [](const Eigen::Vector3d& state) { return std::hypot(state[0], state[1]); };
  const auto angle = [](const Eigen::Vector3d& state) { return std::atan2(state[1], state[0]); };
  CHECK(size(start.filtered_state) - size(start.true_state) == doctest::Approx(0.005));
  CHECK(angle(start.filtered_state) - angle(start.true_state) == doctest::Approx(0.005));
  CHECK(start.filtered_state[2] - start.true_state[2] == doctest::Approx(0.005));
  for (const auto& record : simulation.trajectory) {
    CHECK((record.measurement - record.true_state.head<2>()).norm() <= 0.001);
    CHECK(oracle::least_eigenvalue(record.filtered_covariance) > 0.0);
  }
  CHECK(std::fabs(simulation.trajectory.back().filtered_state[2] - start.true_state[2]) < 0.001);
}

TEST_CASE("a given covariance is taken in the frame of the estimated phase") {
  const auto design = test::design(
      {{"initial_phase_error = 0.005",
        "initial_phase_error = 0.25\ninitial_covariance = [[2, 0, 0], [0, 1, 0.5], [0, 0.5, 1]]"}});
  const theorems::TrajectoryRecord start = certificates::simulate_quadrature(design).trajectory.front();
  // Along the estimate itself the variance is the 2 of the radial direction.
  const Eigen::Vector2d radial = start.filtered_state.head<2>().normalized();
  CHECK(radial.dot(start.filtered_covariance.topLeftCorner<2, 2>() * radial) == doctest::Approx(2.0));
  const Eigen::Vector2d tangential(-radial[1], radial[0]);
  CHECK(tangential.dot(start.filtered_covariance.topRightCorner<2, 1>()) == doctest::Approx(0.5));
}

TEST_CASE("a signal that breaks the assumptions is announced") {
  const auto design = test::design({{"samples = 60", "samples = 60\nsignal = \"la-scala-1994\""}});
  CHECK(certificates::simulate_quadrature(design).notes.size() == 1);
}

TEST_CASE("at unit amplitude everything is divided by the amplitude") {
  const certificates::Simulation simulation =
      certificates::simulate_quadrature(test::design({{"amplitude = 1.0", "amplitude = 4.0"}}));
  const auto unit = certificates::at_unit_amplitude(simulation.trajectory, 4.0);
  for (std::size_t k = 0; k < unit.size(); ++k) {
    CHECK(unit[k].true_state.head<2>().norm() == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(unit[k].filtered_state[2] == simulation.trajectory[k].filtered_state[2]);
    CHECK(unit[k].filtered_covariance(0, 0) * 16.0 == simulation.trajectory[k].filtered_covariance(0, 0));
    CHECK(unit[k].predicted_covariance(1, 2) * 4.0 == simulation.trajectory[k].predicted_covariance(1, 2));
  }
}

}  // namespace
