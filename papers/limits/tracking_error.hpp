// The error of the two extended Kalman filters of trackers/, simulated.
#pragma once

#include <vector>

#include "papers/limits/tracking_model.hpp"

namespace veritrack::limits {

/// A run is lost when the root mean square of its frequency error over the last kLockWindow samples is above
/// this, rad/sample (or not a number).
inline constexpr double kLockThreshold = 0.3;
inline constexpr int kLockWindow = 50;

struct TrackingExperiment {
  TrackingModel model;
  double tracker_q1 = 0.0;   ///< process noise of both parts that the tracker assumes, signal units squared
  double tracker_q2 = 1e-4;  ///< process noise of the frequency that it assumes, (rad/sample)^2; > 0
  int samples = 200;         ///< of a run; >= kLockWindow
  int first_sample = 101;    ///< the mean over a run is taken from this sample on
  int runs = 1000;           ///< with seeds 1, ..., runs
};

struct TrackingErrors {
  std::vector<double> mean_square;  ///< over all runs, (rad/sample)^2, sample k at index k - 1
  double window_mean = 0.0;         ///< mean of that over the samples from first_sample on
  /// The standard error of window_mean, from its scatter over batches of runs; NaN for a single run.
  double standard_error = 0.0;
  double lost = 0.0;  ///< share of the runs that are lost, in [0, 1]
};

/// Simulates the tracker for the model's channels, with r the model's noise variance, no leak, and the P(0)
/// that matches the deviations at the start. The result does not depend on the number of threads. Throws
/// std::invalid_argument when samples, first_sample or runs are not valid.
[[nodiscard]] TrackingErrors simulate_tracking(const TrackingExperiment& experiment);

}  // namespace veritrack::limits
