// The experiment that the bounds of this folder and the simulated trackers share.
//
// A sinusoid of amplitude A, phase phi(k) and frequency omega(k),
//     phi(k+1) = phi(k) + omega(k),   omega(k+1) = omega(k) + w(k),   w(k) normal with variance
//     walk_variance, y(k) = A e^{i phi(k)} + v(k), or its real part alone,   v(k) normal, noise_variance in
//     each channel,
// k = 1, 2, ..., observed after a start with normal errors in amplitude, phase and frequency. All
// of this folder is floating point: it proves nothing.
#pragma once

#include <cmath>
#include <cstdint>

namespace veritrack::limits {

/// The measured channels of the sinusoid.
enum class Channels : std::uint8_t { quadrature, single };

/// Which of the two is random at k = 0. With `truth` the tracker always starts in the same place and the
/// signal is drawn about it: the prior of a posterior bound. With `start` the signal is always the same and
/// the tracker's start is drawn about it: a further measurement of constants, for a bound on their estimates.
enum class DrawnAtStart : std::uint8_t { truth, start };

/// The means of amplitude, phase (rad) and frequency (rad/sample) at k = 0.
inline constexpr double kMeanAmplitude = 1.0;
inline constexpr double kMeanPhase = 0.0;
inline constexpr double kMeanFrequency = 1.5;

struct TrackingModel {
  Channels channels = Channels::quadrature;
  double noise_variance = 0.005;      ///< of each channel, signal units squared
  double walk_variance = 0.0;         ///< of w, (rad/sample)^2
  double amplitude_deviation = 0.1;   ///< standard deviation at the start, signal units
  double phase_deviation = 0.1;       ///< rad
  double frequency_deviation = 0.05;  ///< rad/sample
  DrawnAtStart drawn = DrawnAtStart::truth;
};

/// The noise variance of each channel, signal units squared, at amplitude 1 and a signal-to-noise ratio of
/// `decibels`. The ratio is A^2/2 over the variance of a channel, which for the complex signal is A^2 over
/// E|v|^2: the same number.
[[nodiscard]] inline double noise_variance_of(double decibels) {
  return 0.5 * std::pow(10.0, -0.1 * decibels);
}

}  // namespace veritrack::limits
