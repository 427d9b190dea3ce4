// Gaussian noise of a design, at a signal of amplitude 1, and its words in sentences.
#pragma once

#include <string>

#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// The deviation of each channel relative to the amplitude. The noise must be Gaussian. Needs the upward
/// mode.
[[nodiscard]] rigor::Interval deviation_at_unit_amplitude(const GaussianNoise& noise,
                                                          const Number& amplitude);
[[nodiscard]] rigor::Interval deviation_at_unit_amplitude(const Assumptions& assume);
/// The noise with this signal-to-noise ratio, a decimal in dB, as if a design gave it. Throws what
/// rigor::parse_decimal throws. Needs the upward mode.
[[nodiscard]] GaussianNoise noise_of_snr(const std::string& decibels);
/// The double nearest to it: for simulations. Needs round-to-nearest.
[[nodiscard]] double nearest_deviation(const GaussianNoise& noise, const Number& amplitude);
[[nodiscard]] double nearest_deviation(const Assumptions& assume);

/// Whether `frequency_walk` is present and not zero.
[[nodiscard]] bool frequency_walks(const Assumptions& assume);

/// "within any 1e6 successive samples, however late"; for a frequency that walks, within the first ones.
/// `samples` must be given.
[[nodiscard]] std::string stretch_of_samples(const Assumptions& assume);

/// ", with Gaussian measurement noise of mean zero, ..., and an SNR of at least 17 dB (...)". Needs the
/// upward mode.
[[nodiscard]] std::string gaussian_words(const GaussianNoise& noise, const Number& amplitude);
/// The same of an SNR, in dB, as it is written.
[[nodiscard]] std::string gaussian_words(const std::string& snr_db, const rigor::Interval& unit_deviation);

/// " and is constant, with Gaussian measurement noise of mean zero, ..., and an SNR of at
/// least 17 dB (...)": the assumed noise and
/// walk. Needs the upward mode.
[[nodiscard]] std::string gaussian_disturbance(const Assumptions& assume);

}  // namespace veritrack::certificates
