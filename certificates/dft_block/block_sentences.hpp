// The beginnings of the sentences of a block tracker's certificate.
#pragma once

#include <string>

#include "certificates/dft_block/dft_block_design.hpp"

namespace veritrack::certificates {

/// "In exact arithmetic, the block tracker without leaks, with ...": the filter.
[[nodiscard]] std::string block_filter_words(const BlockTables& tables);

/// "the amplitude 1", "a constant amplitude from 1 to 2".
[[nodiscard]] std::string block_amplitude_words(const BlockAssumptions& assume);

/// The deviation of the real and of the imaginary part of each bin, signal units: that of the samples over
/// the root of 2 T. The noise must be Gaussian. Needs the upward mode.
[[nodiscard]] rigor::Interval bin_deviation(const BlockTables& tables);

/// The design in white noise of another signal-to-noise ratio, a decimal in dB, in place of the assumed one.
/// Needs the upward mode.
[[nodiscard]] BlockTables with_snr(BlockTables tables, const std::string& decibels);

/// Everything before the claim on the assumed tones, noise and starts. Needs the upward mode.
[[nodiscard]] std::string block_hypotheses(const BlockTables& tables);

}  // namespace veritrack::certificates
