// The findings on the published theorems themselves, as claims of a certificate and as a table.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"
#include "certificates/sets/statement_claim.hpp"

namespace veritrack::certificates {

/// The claims with ids "theorem-2.9/<place>" or "theorem-2.9/<place>/<reading>" that test the theorem's
/// proof, one row for each place, its readings side by side. Empty when there are none.
[[nodiscard]] std::string proof_section(const Certificate& certificate);

}  // namespace veritrack::certificates
