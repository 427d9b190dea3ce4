// The tone in a short stretch of a recording, fitted without the tracker: amplitude, frequency, residual.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "reports/recording/samples/sample_source.hpp"
#include "reports/recording/waveform.hpp"

namespace veritrack::reports {

/// All estimates.
struct FittedTone {
  double amplitude = 0.0;            ///< in the middle of the stretch, signal units
  double frequency = 0.0;            ///< likewise, rad/sample
  double frequency_deviation = 0.0;  ///< of that estimate in white noise, rad/sample
  double noise_deviation = 0.0;      ///< of each channel, signal units: the root of the mean squared residual
};

/// Fits D(t) e^{i frequency k} with a complex polynomial D of degree 2, by least squares: that absorbs a
/// frequency that is estimated roughly (to about a turn over the stretch), its slew, and an amplitude that
/// drifts. With one channel, the real part is fitted. A waveform with harmonics is fitted by Gauss's and
/// Newton's method, with polynomials of degree 2 for its amplitude and its phase.
class ToneFit {
 public:
  /// `is_derived`: the second channel is computed from the first, and brings no information of its own.
  ToneFit(std::size_t length, int channels, bool is_derived, const Waveform& waveform);

  /// `samples` of the length, none missing; `frequency` in rad/sample.
  [[nodiscard]] const FittedTone& fit(std::span<const RecordedSample> samples, double frequency);

  /// The tone of the stretch that was fitted last: amplitude and phase at a sample as amplitude e^{i phase},
  /// signal units.
  [[nodiscard]] std::complex<double> tone(std::size_t k) const { return values_[k]; }

 private:
  using Coefficients = Eigen::Matrix<double, 6, 1>;
  [[nodiscard]] Coefficients closest(std::span<const RecordedSample> samples) const;
  void fit_tone(std::span<const RecordedSample> samples, double frequency);
  void fit_waveform(std::span<const RecordedSample> samples, double frequency);

  int channels_;
  bool is_derived_;
  Waveform waveform_;
  Eigen::Matrix<double, Eigen::Dynamic, 3> basis_;  ///< orthonormal polynomials, sample by sample
  double slope_ = 0.0;                              ///< of the second one, per sample
  double bend_ = 0.0;                               ///< the third one in the middle
  std::vector<std::complex<double>> turns_;
  std::vector<std::complex<double>> values_;
  FittedTone fitted_;
};

}  // namespace veritrack::reports
