// Gaussian noise: the mean square of the quadrature tracker's frequency error while in lock.
#pragma once

#include <string>

#include "analysis/quadrature/gaussian/lock_answer.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/sets/guarantee_sentence.hpp"

namespace veritrack::certificates {

/// Adds the derivation "mean-square", with the linearised filter's value beside it, and its evidence: the
/// answer must have one. Call after the derivation "lock" was added. Needs the upward mode.
void add_mean_square(Certificate& certificate, const quadrature::LockQuestion& question,
                     quadrature::LockAnswer answer);

/// The claim "ekf/rms-frequency-error", which [require] must ask for: decided by the derivation
/// "mean-square".
[[nodiscard]] Claim mean_square_claim(const Certificate& certificate, const GuaranteeTerms& terms);

/// Its part of certificate.md.
[[nodiscard]] std::string mean_square_section(const Certificate& certificate);

}  // namespace veritrack::certificates
