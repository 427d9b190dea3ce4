// Statements of the analysis as claims of a certificate.
#pragma once

#include "analysis/statements/statement.hpp"
#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// A statement about a theorem as a claim that is not required.
[[nodiscard]] Claim to_claim(const theorems::Statement& statement);

}  // namespace veritrack::certificates
