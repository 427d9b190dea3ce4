// Claims on starts that never find the tone.
#pragma once

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Whether every start finds the tone, which is REFUTED by either false lock that is proved, and the claims
/// that they are. From the derivations "false-lock-below" and "false-lock-above".
void add_false_lock_claims(Certificate& certificate);

}  // namespace veritrack::certificates
