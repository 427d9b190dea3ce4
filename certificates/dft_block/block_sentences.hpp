// What the sentences of a block tracker's certificate begin with.
#pragma once

#include <string>

#include "certificates/dft_block/dft_block_design.hpp"

namespace veritrack::certificates {

/// "In exact arithmetic, the block tracker without leaks, with ...": the filter.
[[nodiscard]] std::string block_filter_words(const BlockTables& tables);

/// "the amplitude 1", "a constant amplitude from 1 to 2".
[[nodiscard]] std::string block_amplitude_words(const BlockAssumptions& assume);

}  // namespace veritrack::certificates
