// The certificate of the block tracker.
#pragma once

#include "certificates/document/certificate.hpp"
#include "certificates/document/number_json.hpp"

namespace veritrack::certificates {

/// Adds the derivation "lock-set", the claims and their verdict. Needs the upward mode.
void certify_dft_block(Certificate& certificate, const CertifyProgress& progress);

/// The members of certificate.json.
[[nodiscard]] Json dft_block_design_json(const Design& design);

}  // namespace veritrack::certificates
