// certificate.md of a loop that is certified by gains that depend on the phase.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Needs the upward rounding mode, and model_sets(certificate).phases.
[[nodiscard]] std::string model_phases_section(const Certificate& certificate);

}  // namespace veritrack::certificates
