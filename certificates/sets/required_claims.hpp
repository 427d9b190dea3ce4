// The claims in [require] of a design of an extended Kalman filter, and the certificate's verdict.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"
#include "certificates/sets/guarantee_sentence.hpp"

namespace veritrack::certificates {

/// The requirement of [require] at `required`, undecided: in short, and with all hypotheses before it.
[[nodiscard]] Claim required_claim(const char* id, std::string requirement, const std::string& hypotheses,
                                   const Number& required);

/// Adds a claim for each key of [require], decided by the certificate's contraction, and the certificate's
/// verdict. Throws std::bad_optional_access when nothing was certified by contraction. Needs the upward mode.
void add_required_claims(Certificate& certificate, const GuaranteeTerms& terms);

/// Sets the certificate's verdict on all required claims together; empty when nothing is required.
void conclude_requirements(Certificate& certificate);

}  // namespace veritrack::certificates
