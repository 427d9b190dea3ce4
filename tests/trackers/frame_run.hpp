// What every frame of the quadrature tracker's closed loop is tested against: the shipped tracker, over runs
// with noise and slew.
#pragma once

#include <cmath>

#include "tests/support/random.hpp"
#include "tests/trackers/random_tracker.hpp"

namespace veritrack::test {

/// diag(Rot(angle), 1).
inline Eigen::Matrix<long double, 3, 3> turn(long double angle) {
  Eigen::Matrix<long double, 3, 3> u = Eigen::Matrix<long double, 3, 3>::Identity();
  u(0, 0) = u(1, 1) = std::cos(angle);
  u(1, 0) = std::sin(angle);
  u(0, 1) = -u(1, 0);
  return u;
}

/// The largest gap between the map of a frame and the shipped tracker seen from that frame, over 50 runs of
/// 100 samples. `Frame` has State, Input and
///   State from(estimate, true_phase, true_frequency),
///   double noise_angle(state, next_true_phase): the direction that its noise inputs refer to,
///   State next(state, input, design),
///   double gap(state, state).
template <typename Frame>
double worst_gap_over_runs(const Frame& frame, std::uint64_t seed) {
  Random random(seed);
  double worst = 0.0;
  for (int run = 0; run < 50; ++run) {
    const auto design = random_design(random);
    double phase = random.uniform(-3.0, 3.0);
    double frequency = random.uniform(0.1, 2.0);
    const trackers::QuadratureEstimate<double> start{
        std::cos(phase) + 0.1, std::sin(phase) - 0.05, frequency + 0.02,
        trackers::FactoredCovariance<double>::from_matrix(0.1 * random_covariance(random))};
    trackers::QuadratureEkf<double> tracker(design, start);
    typename Frame::State state = frame.from(start, phase, frequency);
    for (int k = 0; k < 100; ++k) {
      const double slew = random.uniform(-0.001, 0.001);
      const double v1 = random.uniform(-0.01, 0.01);
      const double v2 = random.uniform(-0.01, 0.01);
      phase += frequency;
      const double c = std::cos(frame.noise_angle(state, phase));
      const double s = std::sin(frame.noise_angle(state, phase));
      state = frame.next(state, {c * v1 + s * v2, c * v2 - s * v1, slew, frequency}, design);
      tracker.step(std::cos(phase) + v1, std::sin(phase) + v2);
      frequency += slew;
      worst = std::fmax(worst, frame.gap(state, frame.from(tracker.filtered(), phase, frequency)));
    }
  }
  return worst;
}

}  // namespace veritrack::test
