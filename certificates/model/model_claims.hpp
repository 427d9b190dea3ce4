// The sentences of a certificate for a model.
#pragma once

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Adds the claims of [require] and those reported beside them, decided by the certificate's sets
/// (model_sets.hpp), and the certificate's verdict. Needs the upward rounding mode.
void add_model_claims(Certificate& certificate);

}  // namespace veritrack::certificates
