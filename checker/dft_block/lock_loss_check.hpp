// The probability that the block tracker leaves a set in Gaussian noise: docs/block-tracker.md, section 7.
#pragma once

#include <optional>
#include <string>

#include "checker/dft_block/lock_check.hpp"
#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// A design's assumptions on noise and starts.
struct BlockNoise {
  Ball deviation;  ///< of the real and of the imaginary part of a bin, at most
  Ball blocks;
  Vector3 start;                      ///< |z_i| at most
  std::optional<Matrix3> covariance;  ///< P(1|0); none: that of the steady state
};

/// The decimal "snr_db" in the evidence of a derivation "lowest-snr", dB; empty where there is none.
std::string lowest_snr_text(const Tree& derivation);

/// The derivation "lock-in-noise", or "lowest-snr" with its own noise, as the checker computes it from its
/// evidence. `cells` counts the cells.
Derivation lock_in_noise(const Tree& derivation, const BlockProblem& problem, const BlockNoise& noise,
                         std::int64_t& cells, Objections& objections);

}  // namespace veritrack::checker
