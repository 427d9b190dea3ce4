// Gaussian noise: the probability that the quadrature tracker loses lock.
#pragma once

#include <string>

#include "analysis/quadrature/gaussian/lock_certificate.hpp"
#include "certificates/document/certificate.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/sets/guarantee_sentence.hpp"

namespace veritrack::certificates {

/// The question under the assumptions of a design, at amplitude 1; its noise must be Gaussian. Needs the
/// upward mode.
[[nodiscard]] quadrature::LockQuestion lock_question(const QuadratureEkfTables& tables);

/// Adds the derivation "lock", the claim "ekf/probability-of-losing-lock" that [require] asks for, and the
/// guarantee in one sentence. The design's noise must be Gaussian. Needs the upward mode.
void add_lock(Certificate& certificate);

/// The guarantee in one sentence: the statement that a derivation like "lock" proves on these terms, or the
/// reason why it proves none; with the root mean square in lock when there is one.
[[nodiscard]] Claim lock_guarantee(const theorems::Derivation& derivation, const GuaranteeTerms& terms,
                                   const theorems::Quantity* rms = nullptr);

/// Its part of certificate.md.
[[nodiscard]] std::string lock_section(const Certificate& certificate);

/// The coverage of such a certificate and its limits.
[[nodiscard]] std::string lock_coverage_section();

}  // namespace veritrack::certificates
