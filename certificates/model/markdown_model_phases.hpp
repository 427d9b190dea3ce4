// certificate.md of a loop that is certified by gains that depend on the phase.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Needs the upward rounding mode, and model_sets(certificate).phases.
[[nodiscard]] std::string model_phases_section(const Certificate& certificate);

/// Noise and starts of a loop whose ripple is averaged, beside tubes. Needs the upward rounding mode, and
/// model_sets(certificate).averages.
[[nodiscard]] std::string model_averages_section(const Certificate& certificate);

}  // namespace veritrack::certificates
