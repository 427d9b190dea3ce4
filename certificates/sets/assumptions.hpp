// [assume], [require] and [simulate] of the trackers whose errors a contraction certificate bounds.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "certificates/design/design.hpp"

namespace veritrack::certificates {

/// P(0|0) in the frame of the estimated phase: the filter's steady state, or a symmetric positive definite
/// matrix, row by row.
using CovarianceArray = std::array<std::array<Number, 3>, 3>;

/// Errors of the samples without a bound: independent from sample to sample and from channel to channel,
/// Gaussian with mean zero. Exactly one of the two.
struct GaussianNoise {
  std::optional<Number> snr_db;     ///< 10 log10(amplitude^2 / (2 deviation^2)), dB
  std::optional<Number> deviation;  ///< of each channel, signal units
};

/// [assume].
struct Assumptions {
  Number amplitude;                   ///< signal units
  std::optional<Number> sample_rate;  ///< Hz
  std::array<Number, 2> frequency;    ///< [lowest, highest], rad/sample
  /// |v(k)| <= noise for every k, signal units. Empty where the noise is Gaussian: nothing follows from it.
  Number noise;
  std::optional<GaussianNoise> gaussian;
  std::optional<Number> frequency_walk;  ///< deviation of Gaussian steps of the frequency, rad/sample
  std::optional<Number> samples;         ///< the number for which a probability is asked; given with Gaussian
                                         ///< noise
  Number slew;                           ///< |omega(k+1) - omega(k)| <= slew, rad/sample per sample
  Number initial_frequency_error;        ///< rad/sample
  Number initial_phase_error;            ///< rad
  Number initial_amplitude_error;        ///< signal units
  /// At most one of the three; none: "steady-state". Every P(0|0) from the first to the second matrix in the
  /// Loewner order, or from the first to the second multiple of the matrix that the certificate prints.
  std::optional<CovarianceArray> initial_covariance;
  std::optional<std::array<CovarianceArray, 2>> covariance_range;
  std::optional<std::array<Number, 2>> covariance_multiples;
};

/// [require]: the claims that CI must find PROVED.
struct Requirements {
  std::optional<Number> frequency_error_below;            ///< rad/sample, for ever
  std::optional<Number> settles_within;                   ///< samples, after which the frequency error stays
  std::optional<Number> settled_below;                    ///< below that many rad/sample
  std::optional<Number> largest_noise_at_least;           ///< signal units, at a constant frequency
  std::optional<Number> largest_slew_at_least;            ///< rad/sample per sample, without noise
  std::optional<Number> frequency_error_radius_at_least;  ///< rad/sample, of an invariant set
  // With Gaussian noise, within the assumed samples:
  std::optional<Number> probability_of_losing_lock_below;
  std::optional<Number> rms_frequency_error_below;  ///< rad/sample, while in lock
};

/// [simulate]: the run that the audit and the figures use.
struct SimulationSettings {
  std::int64_t samples = 1000;
  std::uint64_t seed = 1;
  std::string signal = "constant";
};

}  // namespace veritrack::certificates
