// The lowest signal-to-noise ratio at which the quadrature tracker is certified to keep its lock, beside the
// results of a simulation and of the bounded-noise certificate.
#pragma once

#include <optional>
#include <string>

#include "analysis/quadrature/gaussian/lock_certificate.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/sets/guarantee_sentence.hpp"

namespace veritrack::certificates {

/// Adds the derivation "lowest-snr" and, when there is a set, the claim "ekf/lowest-snr": the sentence of the
/// guarantee at that ratio. `found` answers the question about the assumed noise. Nothing with a leak. Needs
/// the upward mode.
void add_lowest_snr(Certificate& certificate, const quadrature::LockQuestion& question,
                    const quadrature::LockCertificate& found, const GuaranteeTerms& terms);

/// Its part of certificate.md.
[[nodiscard]] std::string lowest_snr_section(const Certificate& certificate);

}  // namespace veritrack::certificates
