// The requirements on the linear loop: damping, time constant, noise bandwidth and gain margin.
#pragma once

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Adds the claims of [require] that are about the linear recursion of a loop that is certified by gains;
/// undecided, with the reason, for another. Needs the upward rounding mode.
void add_loop_claims(Certificate& certificate);

}  // namespace veritrack::certificates
