// The statements of a certificate that a proof assistant can check, as a section of certificate.md.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// A table of the statements that certificate.v proves. Empty without formal proofs.
[[nodiscard]] std::string formal_proofs_section(const Certificate& certificate);

}  // namespace veritrack::certificates
