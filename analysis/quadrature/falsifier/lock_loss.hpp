// How often the tracker loses lock in simulation, for comparison with a certified probability. Proves
// nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// A signal-to-noise ratio, and how often lock was lost there.
struct LossRate {
  double decibels = 0.0;
  std::int64_t samples = 0;
  std::int64_t losses = 0;
  [[nodiscard]] double rate() const { return static_cast<double>(losses) / static_cast<double>(samples); }
};

/// log(rate) = intercept + slope/sigma^2: what an exit over a barrier in weak noise does.
struct LossLaw {
  double intercept = 0.0, slope = 0.0;
  [[nodiscard]] double rate_at(double decibels) const;
  /// The signal-to-noise ratio, dB, at which the rate is this.
  [[nodiscard]] double decibels_of(double rate) const;
};

struct LockLoss {
  std::vector<LossRate> rates;  ///< by ascending signal-to-noise ratio
  std::optional<LossLaw> law;   ///< none when there are too few rates
};

/// Simulates the tracker in the frame of the true phase, amplitude 1, constant frequency or one that walks by
/// `frequency_walk` (rad/sample) a sample, in Gaussian noise of ever higher signal-to-noise ratio, until lock
/// is hardly ever lost. It is lost when the frequency error exceeds pi/2 rad/sample or the phase error 2 pi;
/// the run then restarts from the steady state. The law is fitted to the ratios at which losses are rare but
/// still occur, by least squares, weighted by the numbers of losses: beyond them it is an extrapolation.
/// Without a steady state there are no rates. Deterministic, some seconds of one core, shared among threads.
/// Opens its own NearestRounding scopes. epsilon must be zero.
[[nodiscard]] LockLoss simulate_lock_loss(const trackers::ToneModel<double>& design, double frequency_walk);

}  // namespace veritrack::quadrature
