// The words of a contraction certificate over phases that speak of the design file.
#pragma once

#include "analysis/single_channel/phase_certificate.hpp"

namespace veritrack::certificates {

/// Completes the condition start-in-set, where there is one.
void add_words(single_channel::PhaseCertificate& found);

}  // namespace veritrack::certificates
