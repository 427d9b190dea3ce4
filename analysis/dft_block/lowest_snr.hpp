// The lowest signal-to-noise ratio for which a probability of losing lock is proved for the block tracker:
// docs/block-tracker.md, section 7.
#pragma once

#include "analysis/dft_block/lock_loss.hpp"

namespace veritrack::dft_block {

struct LowestSnrQuestion {
  LossQuestion loss;               ///< with the assumed deviation, near which the search begins
  rigor::Interval unit_deviation;  ///< that of a part of a bin at 0 dB, signal units
  rigor::Interval probability;     ///< of losing lock within the blocks, at most
};

/// The derivation "lowest-snr": conditions and evidence as for "lock-in-noise", for its own noise, whose
/// ratio stands as the decimal "snr_db" in the evidence and as the quantity "lowest_snr", dB. A verified
/// drift is valid for any noise, so the search is over sets and needs one verification. Opens its own
/// rounding scopes.
[[nodiscard]] theorems::Derivation derive_lowest_snr(const LowestSnrQuestion& question);

}  // namespace veritrack::dft_block
