// The part of certificate.md that shows what this program itself proves of the design.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Conditions, the certified set in engineering units, what it covers, and how starts beyond it were
/// followed.
[[nodiscard]] std::string contraction_section(const Certificate& certificate);

}  // namespace veritrack::certificates
