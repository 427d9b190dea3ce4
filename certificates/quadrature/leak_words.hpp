// The words of a contraction certificate with a leak that speak of the design file.
#pragma once

#include "analysis/quadrature/leak/steady_certificate.hpp"

namespace veritrack::certificates {

/// Completes the condition start-in-set, where there is one, and says what helps where the lock branch ends
/// inside the band.
void add_words(quadrature::LeakCertificate& found);

}  // namespace veritrack::certificates
