// What is proved of the block tracker in Gaussian noise: the probability that it loses lock, the mean square
// while it has it, and how loud the noise may be.
#pragma once

#include "analysis/dft_block/lock_certificate.hpp"
#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Adds the derivation "lock-in-noise" and, where everything is asked for and there is one amplitude,
/// "lowest-snr". The question has the design and the starts. Needs the upward mode.
void derive_block_loss(Certificate& certificate, const dft_block::LockQuestion& lock);

/// Adds the claims that rest on them. Needs the upward mode.
void add_block_loss_claims(Certificate& certificate);

}  // namespace veritrack::certificates
