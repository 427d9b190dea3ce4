#include "certificates/dft_block/block_sentences.hpp"

#include <fmt/format.h>

#include "analysis/rigor/decimal.hpp"
#include "certificates/sets/gaussian_noise.hpp"

namespace veritrack::certificates {

std::string block_filter_words(const BlockTables& tables) {
  const BlockDesignTable& design = tables.design;
  return fmt::format(
      "In exact arithmetic, the block tracker without leaks, with Q = diag({}, {}, {}), R = {} I and the "
      "bins "
      "M - {} ... M + {}",
      design.q1.text, design.q2.text, design.q3.text, design.r.text, design.half_width.text,
      design.half_width.text);
}

std::string block_amplitude_words(const BlockAssumptions& assume) {
  return assume.one_amplitude ? fmt::format("the amplitude {}", assume.amplitude[0].text)
                              : fmt::format("a constant amplitude from {} to {}", assume.amplitude[0].text,
                                            assume.amplitude[1].text);
}

rigor::Interval bin_deviation(const BlockTables& tables) {
  const Number& amplitude = tables.assume.amplitude[0];
  return deviation_at_unit_amplitude(tables.assume.gaussian.value(), amplitude) * amplitude.value /
         sqrt(rigor::Interval(2.0) * tables.design.block_length.value().value);
}

BlockTables with_snr(BlockTables tables, const std::string& decibels) {
  tables.assume.gaussian = noise_of_snr(decibels);
  return tables;
}

namespace {

std::string block_noise_words(const BlockTables& tables) {
  const BlockAssumptions& assume = tables.assume;
  if (!assume.gaussian) {
    return "plus noise whose length in all bins of a block together is at most " + assume.noise.text;
  }
  constexpr int kDigits = 3;
  return fmt::format(
      "in a way that does not depend on the noise, plus Gaussian noise of mean zero, independent from block "
      "to "
      "block and from bin to bin, with independent real and imaginary parts of a deviation of at most {} "
      "each: "
      "that of the bins between 0 and T/2 of blocks of T = {} samples with white noise and {}",
      rigor::lower_decimal(bin_deviation(tables), kDigits), tables.design.block_length->text,
      assume.gaussian->snr_db ? fmt::format("an SNR of at least {} dB", assume.gaussian->snr_db->text)
                              : fmt::format("a deviation of at most {}", assume.gaussian->deviation->text));
}

}  // namespace

std::string block_hypotheses(const BlockTables& tables) {
  const BlockAssumptions& assume = tables.assume;
  std::string covariance = "of the steady state in exact lock in the middle of these offsets";
  if (!assume.initial_covariance.empty()) {
    const auto entry = [&](std::size_t i) -> const std::string& { return assume.initial_covariance[i].text; };
    covariance = fmt::format("[[{}, {}, {}], [{}, {}, {}], [{}, {}, {}]]", entry(0), entry(1), entry(2),
                             entry(3), entry(4), entry(5), entry(6), entry(7), entry(8));
  }
  return fmt::format(
      "{}, is fed with the bins (4.9) of a tone of {}, constant within each block and continuous in phase "
      "from one to the next, whose offset is between "
      "{} "
      "and {} bins in every block and changes by at most {} bins from one to the next, {}. Its first "
      "prediction "
      "has a root amplitude x1 within {} of the tone's, relative to it, a phase within {} rad at the middle "
      "of "
      "the block, an offset within {} bins, and the covariance {}. Then ",
      block_filter_words(tables), block_amplitude_words(assume), assume.offset[0].text, assume.offset[1].text,
      assume.slew.text, block_noise_words(tables), assume.initial_amplitude_error.text,
      assume.initial_phase_error.text, assume.initial_offset_error.text, covariance);
}

}  // namespace veritrack::certificates
