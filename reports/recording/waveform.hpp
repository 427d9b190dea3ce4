// The periodic signal that a design assumes, as its harmonics, for comparison with a recording's tone.
#pragma once

#include <complex>
#include <numbers>
#include <span>
#include <vector>

#include "certificates/document/tracker_run.hpp"

namespace veritrack::reports {

inline constexpr double kWholeTurn = 2.0 * std::numbers::pi;  // rad

/// Amplitude and phase of a periodic signal.
struct MatchedTone {
  double amplitude = 0.0;  ///< signal units
  double phase = 0.0;      ///< rad
};

class Waveform {
 public:
  /// `signal` of a design; with one channel the real part of it. Needs a harmonic that is not zero.
  Waveform(std::span<const certificates::Harmonic> signal, int channels);

  /// Whether it is a tone alone.
  [[nodiscard]] bool is_tone() const { return harmonics_.size() == 1 && harmonics_.front().order == 1; }
  /// By order; the orders of one channel are not negative.
  [[nodiscard]] std::span<const certificates::Harmonic> harmonics() const { return harmonics_; }
  [[nodiscard]] bool has(int order) const;
  /// The sample at a phase, of amplitude 1, and its derivative by the phase.
  [[nodiscard]] std::complex<double> at(double phase) const;
  [[nodiscard]] std::complex<double> derivative(double phase) const;

  /// `means`, one for each harmonic: those of y(k) e^{-i order psi(k)}. The power that the waveform explains
  /// when its harmonics have their proportions and any phases: (sum of sqrt(weight * power))^2, which is the
  /// whole power for the waveform itself, and less for any other signal (Cauchy and Schwarz).
  [[nodiscard]] double power(std::span<const std::complex<double>> means) const;
  /// The waveform that is closest to these means.
  [[nodiscard]] MatchedTone match(std::span<const std::complex<double>> means) const;

 private:
  int channels_;
  std::vector<certificates::Harmonic> harmonics_;
  std::vector<double> gains_;  ///< amplitude over mean
  std::vector<double> parts_;  ///< power over squared amplitude
  double power_ = 0.0;         ///< of amplitude 1
};

}  // namespace veritrack::reports
