// The proofs for the block tracker on assumed tones and starts: docs/block-tracker.md.
#pragma once

#include <cstdint>
#include <optional>

#include "analysis/dft_block/lock_set.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::dft_block {

/// A problem with its starts: bounds on the errors of the first prediction.
struct LockQuestion {
  LockProblem problem;
  rigor::Interval amplitude_error;  ///< |x1/x1_true - 1|
  rigor::Interval phase_error;      ///< at the middle of the first block, rad
  rigor::Interval offset_error;     ///< bins
  /// P(1|0) of (x1, phase at the start of the block, offset); none: that of the steady state in exact lock in
  /// the middle of the band, for the only amplitude.
  std::optional<rigor::IntervalMatrix<3>> covariance;
  /// The error that counts as settled, bins; none: twice the bound of the long run.
  std::optional<double> settled_error;
  std::int64_t most_cells = 400'000;  ///< of one verification
};

/// The derivation "lock-set": a set, its rate, and the bounds that follow, with the evidence "lock". Its
/// conditions: "rate", "noise" and "start". Opens its own rounding scopes.
[[nodiscard]] theorems::Derivation derive_lock(const LockQuestion& question);

}  // namespace veritrack::dft_block
