// The covariance of the single-channel tracker without a leak over a window of samples, at every phase and
// every frequency of a band: docs/single-channel.md, section 4.
#pragma once

#include <cstdint>
#include <vector>

#include "checker/single_channel/single_channel_design.hpp"

namespace veritrack::checker {

/// A certificate's statement on the windows of a set. e = (delta, nu) is the error in the frame of the true
/// phase, relative to the amplitude and in rad/sample.
struct WindowStatement {
  /// As long as e' P^-1 e <= radius^2 at every sample,
  Ball radius;
  /// P33 <= frequency_variance and P <= signal_variance on the first two components;
  Ball frequency_variance, signal_variance;
  Ball loosening;  ///< eta, a free number of the proof
  Ball slew;       ///< bound on |omega(k+1) - omega(k)|, rad/sample
  /// The change of P by rounding in a step, as a share of it; zero for a tracker in real arithmetic.
  Ball covariance_rounding;
  /// at least the part shares[m - 1] of any covariance is due to its last m samples;
  std::vector<Ball> shares;
  /// |nu| |delta + i nu/2| <= curvature e' P^-1 e, by a free weight;
  Ball curvature, curvature_weight;
  /// every predicted covariance is above signal_uncertainty diag(1, 1, 0);
  Ball signal_uncertainty;
  /// when the window has them, the diagonal of every covariance is above these;
  bool has_least = false;
  Ball least_p11, least_p22, least_p33;
  /// and, when it has starts, diag(start_signal, start_signal, start_frequency) is below every covariance.
  bool has_starts = false;
  Ball start_signal, start_frequency;
};

/// True only when all of it is proved at every phase, for every frequency of the design's band. Counts the
/// cells of phase and frequency that were needed.
bool window_is_proved(const WindowStatement& statement, const SingleChannelDesign& design,
                      std::int64_t& cells);

}  // namespace veritrack::checker
