#include "certificates/dft_block/block_sentences.hpp"

#include <fmt/format.h>

namespace veritrack::certificates {

std::string block_filter_words(const BlockTables& tables) {
  const BlockDesignTable& design = tables.design;
  return fmt::format(
      "In exact arithmetic, the block tracker without leaks, with Q = diag({}, {}, {}), R = {} I and the bins "
      "M - {} ... M + {}",
      design.q1.text, design.q2.text, design.q3.text, design.r.text, design.half_width.text,
      design.half_width.text);
}

std::string block_amplitude_words(const BlockAssumptions& assume) {
  return assume.one_amplitude ? fmt::format("the amplitude {}", assume.amplitude[0].text)
                              : fmt::format("a constant amplitude from {} to {}", assume.amplitude[0].text,
                                            assume.amplitude[1].text);
}

}  // namespace veritrack::certificates
