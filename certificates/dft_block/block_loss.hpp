// The proofs for the block tracker in Gaussian noise: the probability that it loses lock, the mean square
// while in lock, and the largest admissible noise.
#pragma once

#include "analysis/dft_block/lock_certificate.hpp"
#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Adds the derivation "lock-in-noise" and, where everything is requested and there is one amplitude,
/// "lowest-snr". The question has the design and the starts. Needs the upward mode.
void derive_block_loss(Certificate& certificate, const dft_block::LockQuestion& lock);

/// Adds the claims that rest on them. Needs the upward mode.
void add_block_loss_claims(Certificate& certificate);

}  // namespace veritrack::certificates
