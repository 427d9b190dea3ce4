// The probability that the block tracker leaves a set about the exact lock, in Gaussian noise:
// docs/block-tracker.md, section 7.
#pragma once

#include <cstdint>
#include <optional>

#include "analysis/dft_block/lock_set.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::dft_block {

/// A problem, whose bound on the noise is not used, with its noise and its starts.
struct LossQuestion {
  LockProblem problem;
  rigor::Interval deviation;  ///< of the real and of the imaginary part of each bin, at most, signal units
  rigor::Interval blocks;     ///< within which lock is not to be lost
  rigor::Interval amplitude_error, phase_error, offset_error;  ///< as for LockQuestion
  std::optional<rigor::IntervalMatrix<3>> covariance;          ///< likewise
  std::int64_t most_cells = 400'000;                           ///< of one verification
};

/// The consequences of a verified drift.
struct LossBound {
  rigor::Interval level;                      ///< theta radius^2 / 2
  rigor::Interval start_level;                ///< theta |e_1|^2 / 2 at most
  rigor::Interval probability;                ///< that it is left within the blocks, at most
  rigor::Interval mean_square;                ///< E |e_k|^2 in lock, at most, in every block
  rigor::Interval mean_square_without_start;  ///< the same from an exact start
};

/// `slew_share` is zeta > 0, by which |Ae + ws|^2 <= (1 + zeta)|Ae|^2 + (1 + 1/zeta)|ws|^2; without slew it
/// is not used. Empty when the growth with that share is not below 1. Needs the upward mode.
[[nodiscard]] std::optional<LossBound> loss_bound(const LossQuestion& question, const LockFrame& frame,
                                                  const LockDrift& drift, double slew_share);

/// The derivation "lock-in-noise", with the evidence "drift". Its conditions: "drift" and "start". Opens its
/// own rounding scopes.
[[nodiscard]] theorems::Derivation derive_loss(const LossQuestion& question);

}  // namespace veritrack::dft_block
