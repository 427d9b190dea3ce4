// The contraction certificate of the single-channel tracker without a leak, over all phases and a band of
// frequencies (docs/single-channel.md, section 4), re-established from the numbers of its windows.
#pragma once

#include <cstdint>

#include "checker/sets/guarantee.hpp"
#include "checker/single_channel/single_channel_design.hpp"

namespace veritrack::checker {

/// Objects to every statement of the derivation "contraction" that its evidence does not prove. Counts cells
/// of phase and frequency.
Promises check_phase_contraction(const Tree& derivation, const SingleChannelDesign& design,
                                 std::int64_t& cells, Objections& objections);

}  // namespace veritrack::checker
