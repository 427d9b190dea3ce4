// The section of certificate.md on Gaussian noise, for a model.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Empty where the noise has a bound. Needs the upward rounding mode.
[[nodiscard]] std::string model_lock_section(const Certificate& certificate);

}  // namespace veritrack::certificates
