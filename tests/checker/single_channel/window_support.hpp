// A window that is true of the tracker that runs, with room.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "checker/single_channel/covariance_window.hpp"
#include "tests/support/oracles.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace veritrack::test::window {

using checker::Ball;
using checker::WindowStatement;

inline constexpr double kFrequency = 1.45;  // rad/sample
inline constexpr double kQ = 0.005;
inline constexpr double kR = 0.01;

/// Extremes along the steady state of the tracker on a tone, without errors.
struct Extremes {
  double most_p33 = 0.0, most_signal = 0.0, least_p33 = 1.0, least_predicted = 1.0, most_inverse = 0.0;
};

inline Extremes along_a_tone() {
  trackers::SingleChannelEkf<double> tracker({trackers::identity_process_noise(kQ), kR, 0.0},
                                             {1.0, 0.0, kFrequency, trackers::identity_process_noise(kQ)});
  Extremes found;
  for (int k = 1; k <= 2000; ++k) {
    tracker.step(std::cos(kFrequency * k));
    if (k < 200) {
      continue;
    }
    const Eigen::Matrix3d p = tracker.filtered().covariance.matrix();
    const Eigen::Matrix3d predicted = tracker.predicted().covariance.matrix();
    found.most_p33 = std::max(found.most_p33, p(2, 2));
    found.least_p33 = std::min(found.least_p33, p(2, 2));
    found.most_signal = std::max(found.most_signal, oracle::largest_eigenvalue(p.topLeftCorner<2, 2>()));
    found.least_predicted =
        std::min(found.least_predicted, oracle::least_eigenvalue(predicted.topLeftCorner<2, 2>()));
    found.most_inverse = std::max(found.most_inverse, p.inverse()(2, 2));
  }
  return found;
}

inline checker::SingleChannelDesign design_of_the_tone() {
  checker::SingleChannelDesign design;
  design.q1 = design.q2 = Ball(kQ);
  design.r = Ball(kR);
  design.lowest = design.highest = Ball(kFrequency);
  return design;
}

/// True of the tone, with room.
inline WindowStatement true_statement(const Extremes& seen) {
  WindowStatement statement;
  statement.radius = Ball(1e-3);
  statement.frequency_variance = Ball(1.1 * seen.most_p33);
  statement.signal_variance = Ball(1.1 * seen.most_signal);
  statement.loosening = Ball(0.01);
  statement.slew = Ball(0.0);
  statement.shares = {Ball(0.01), Ball(0.02), Ball(0.05), Ball(0.1), Ball(0.2)};
  statement.curvature = Ball(0.1);
  statement.curvature_weight = Ball(2.0);
  statement.signal_uncertainty = Ball(0.5 * kQ);
  statement.has_least = true;
  statement.least_p33 = Ball(0.8 * seen.least_p33);
  statement.has_starts = true;
  statement.start_signal = Ball(1e-6);
  statement.start_frequency = Ball(0.25 / seen.most_inverse);
  return statement;
}

}  // namespace veritrack::test::window
