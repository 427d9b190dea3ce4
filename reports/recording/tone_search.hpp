// Where in a band the tone of a recording is: the periodogram, for a tone or for the waveform of a design.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "reports/recording/samples/sample_source.hpp"
#include "reports/recording/waveform.hpp"

namespace veritrack::reports {

/// The waveform's share in a stretch of samples. All are estimates.
struct FoundTone {
  std::size_t length = 0;  ///< samples that were used
  double frequency = 0.0;  ///< rad/sample
  double share = -1.0;     ///< of the power (with Hann's window, without the mean), in [0, 1]; -1: not found
  double amplitude = 0.0;  ///< in the middle, signal units
  double phase = 0.0;      ///< likewise, rad
};

class ToneSearch {
 public:
  /// `band` in rad/sample.
  ToneSearch(const Waveform& waveform, int channels, const std::array<double, 2>& band);

  /// The largest value of the periodogram of all these samples, from `lowest` rad/sample on.
  [[nodiscard]] FoundTone in(std::span<const RecordedSample> samples, double lowest);
  /// In the first 2^j samples for the j from `least` samples on, and in all of them: of those lengths that
  /// have at least four periods, the longest one whose share is nearly the largest. A tone whose frequency
  /// moves is found in few samples, a slow one in many.
  [[nodiscard]] FoundTone in_first(std::span<const RecordedSample> samples, std::size_t least);

 private:
  void weigh(std::span<const RecordedSample> samples);
  [[nodiscard]] double power_at(double frequency);

  Waveform waveform_;
  int channels_;
  std::array<double, 2> band_;
  Eigen::FFT<double> transform_;
  std::vector<std::complex<double>> weighted_;
  std::vector<std::complex<double>> padded_;
  std::vector<std::complex<double>> spectrum_;
  std::vector<std::complex<double>> means_;
  double weights_ = 0.0;  ///< their sum
  double power_ = 0.0;    ///< of the samples, weighted
};

}  // namespace veritrack::reports
