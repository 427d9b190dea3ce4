// The textbook filter in double, from the worst that a result allows: its filtered errors, step by step.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/analysis/theorems/theorem_2_9_designs.hpp"
#include "tests/support/random.hpp"
#include "tests/trackers/textbook_ekf.hpp"

namespace veritrack::test {

/// P(k|k) of the filter that has long followed a clean signal of amplitude 1 (epsilon = 0).
inline Eigen::Matrix3d steady_state(const TestDesign& design) {
  TextbookEkf<double> filter{design.q1,      design.q2,       design.r,
                             design.epsilon, {1.0, 0.0, 0.0}, design.q1 * Eigen::Matrix3d::Identity()};
  for (int k = 0; k < 3000; ++k) {
    filter.step({1.0, 0.0});
  }
  return 0.5 * (filter.P + filter.P.transpose());
}

/// e(k|k), k = 0, 1, ...: a signal of amplitude 1 and constant frequency, a random initial error of that
/// length, noise of that length in random or in adverse directions. Signal units and rad/sample.
inline std::vector<Eigen::Vector3d> simulated_errors(const TestDesign& design, double initial_error,
                                                     double noise, int steps, Random& random) {
  const double frequency = random.uniform(-3.0, 3.0);
  double phase = random.uniform(0.0, 6.0);
  const auto signal = [&] { return Eigen::Vector3d(std::cos(phase), std::sin(phase), frequency); };
  Eigen::Vector3d error(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  if (random.below(3) == 0) {
    error = Eigen::Vector3d::UnitZ();
  }
  error *= initial_error / error.norm();
  TextbookEkf<double> filter{design.q1,      design.q2,        design.r,
                             design.epsilon, signal() - error, steady_state(design)};
  const double turn = std::atan2(filter.x(1), filter.x(0));
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  frame.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(turn).toRotationMatrix();
  filter.P = frame * filter.P * frame.transpose();
  const bool adverse = random.below(2) == 0;
  std::vector<Eigen::Vector3d> errors{error};
  for (int k = 0; k < steps; ++k) {
    phase += frequency;
    const double angle = adverse ? phase + 0.5 * std::numbers::pi : random.uniform(0.0, 6.3);
    const Eigen::Vector3d state = signal();
    filter.step(state.head<2>() + noise * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    errors.emplace_back(state - filter.x);
  }
  return errors;
}

}  // namespace veritrack::test
