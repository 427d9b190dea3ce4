// The part of certificate.md that shows what this program itself proves of the design.
#pragma once

#include <string>

#include "certificates/certificate.hpp"

namespace veritrack::certificates {

/// Conditions, the certified set in engineering units, and what it covers.
[[nodiscard]] std::string contraction_section(const Certificate& certificate);

/// One line for the top of the document: what is proved, or that nothing is.
[[nodiscard]] std::string contraction_summary(const Certificate& certificate);

}  // namespace veritrack::certificates
