// Whether a tracker follows the tone that is in the recording, for any tracker: from its frequency alone.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "reports/recording/samples/sample_source.hpp"
#include "reports/recording/waveform.hpp"

namespace veritrack::reports {

/// The share of the power of the last `window` samples that is in a tone that turns with the estimated
/// frequency. With psi(k+1) = psi(k) + estimate(k) it is
///     |sum y(k) e^{-i psi(k)}|^2 / (n sum |y(k)|^2)
/// for two channels and n samples, and twice that for one (a tone has half of its power in e^{i psi}). It is
/// 1 for a tone without noise whose frequency is estimated well, SNR/(1 + SNR) in white noise, and close to
/// 1/n where the estimates have nothing to do with the recording. For the waveform of a design whose signal
/// has harmonics it is the share of the power in them, in their proportions (Waveform::power).
class LockIndicator {
 public:
  LockIndicator(std::size_t window, int channels, const Waveform& waveform);

  /// Forgets everything: the tracker restarts.
  void clear();
  /// A sample, and the frequency (rad/sample) that is estimated with it.
  void push(const RecordedSample& sample, double frequency);
  /// A sample that is missing: the tone turns, and the window stays with the samples before.
  void pass(double frequency);
  /// The share, in [0, 1]; NaN before a quarter of the window is full.
  [[nodiscard]] double share() const;

 private:
  int channels_;
  Waveform waveform_;
  double phase_ = 0.0;                                     ///< psi, rad
  std::vector<std::vector<std::complex<double>>> turned_;  ///< for each harmonic
  std::vector<double> power_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  std::vector<std::complex<double>> turned_sums_;
  double power_sum_ = 0.0;
};

}  // namespace veritrack::reports
