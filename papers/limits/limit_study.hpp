// The grid of experiments for the report on limits: both trackers compared with their bounds, over the
// signal-to-noise ratio and over the number of samples.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "papers/limits/tracking_error.hpp"
#include "papers/limits/tracking_model.hpp"

namespace veritrack::limits {

/// A tracker compared with the bound. Variances and mean square errors in (rad/sample)^2.
struct LimitPoint {
  double decibels = 0.0;        ///< signal-to-noise ratio
  double bound = 0.0;           ///< mean over the samples that count, as is the error
  double error = 0.0;           ///< mean square over all runs
  double standard_error = 0.0;  ///< of the error; NaN when there is one run only
  double lost = 0.0;            ///< share of the runs
};

/// 10 log10 of error over bound.
[[nodiscard]] double decibels_above_bound(const LimitPoint& point);

/// A point is near its bound when it is at most this far above it.
inline constexpr double kNearBound = 1.0;  // dB

/// A difference counts from this many standard errors on: a smaller one may be chance.
inline constexpr double kStandardErrors = 2.0;

/// Whether a point is near its bound, as far as its runs say.
enum class Nearness { near, far, undecided };
[[nodiscard]] Nearness nearness_of(const LimitPoint& point);

/// The lowest signal-to-noise ratio of the grid from which on every point is near its bound: between the one
/// from which on no point is far, and the one from which on all are near. An end is missing when the last
/// point is far, or not near.
struct Threshold {
  std::optional<double> at_least;
  std::optional<double> at_most;
  [[nodiscard]] bool is_decided() const { return at_least == at_most; }
};
/// `points` in rising order.
[[nodiscard]] Threshold threshold_of(const std::vector<LimitPoint>& points);

/// Receives how many of how many experiments have been simulated.
using StudyProgress = std::function<void(int, int)>;

/// The signal-to-noise ratios of the study, dB: 0, 3, ..., 30.
[[nodiscard]] std::vector<double> studied_decibels();

/// A random walk of the frequency, tracked with q2 and r equal to the signal's.
struct RandomWalkSeries {
  Channels channels = Channels::quadrature;
  double walk_variance = 0.0;      ///< (rad/sample)^2
  double q1_share = 0.0;           ///< tracker_q1 by tracker_q2; 0 is the signal's
  std::vector<LimitPoint> points;  ///< over studied_decibels(); mean over the last half of the run
};

inline constexpr int kRandomWalkSamples = 200;

inline constexpr std::array<double, 3> kWalkVariances{1e-6, 1e-4, 1e-3};  // (rad/sample)^2
inline constexpr double kSomeQ1 = 0.1;

/// For both trackers, all kWalkVariances, and a q1_share of 0 and of kSomeQ1, in that order.
[[nodiscard]] std::vector<RandomWalkSeries> study_random_walks(int runs, const StudyProgress& progress = {});

/// A constant frequency, tracked with q2 near zero: errors after 100 and after 1000 samples.
struct ConstantSeries {
  Channels channels = Channels::quadrature;
  std::vector<LimitPoint> early;  ///< over studied_decibels(), after kEarlySample samples
  std::vector<LimitPoint> late;   ///< after kLateSample samples
};

inline constexpr int kEarlySample = 100;
inline constexpr int kLateSample = 1000;
inline constexpr double kNearlyZeroQ2 = 1e-14;  // (rad/sample)^2

[[nodiscard]] std::vector<ConstantSeries> study_constant_frequency(int runs,
                                                                   const StudyProgress& progress = {});

/// The same at one signal-to-noise ratio over time, for one q2 of the tracker.
struct ErrorOverTime {
  Channels channels = Channels::quadrature;
  double tracker_q2 = 0.0;          ///< (rad/sample)^2
  std::vector<double> mean_square;  ///< sample k at index k - 1, up to kLateSample
  double standard_error = 0.0;      ///< of the last
};

inline constexpr double kOverTimeDecibels = 20.0;

/// For q2 = 1e-14, 1e-10, 1e-8 and 1e-6, both trackers.
[[nodiscard]] std::vector<ErrorOverTime> study_errors_over_time(int runs, const StudyProgress& progress = {});

/// The signal of these experiments: constant, with the tracker's start drawn about it.
[[nodiscard]] TrackingModel constant_frequency_model(Channels channels, double decibels);

}  // namespace veritrack::limits
