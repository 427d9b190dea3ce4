// The part of published-theorems.md that shows a published theorem, in its several readings side by side.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// The theorem in a few lines of numbers.
[[nodiscard]] std::string theorem_summary(const Certificate& certificate);

/// Conditions with verdicts, reading by reading, and their notes.
[[nodiscard]] std::string conditions_section(const Certificate& certificate);

/// Every constant: symbol, formula, enclosure in each reading, source.
[[nodiscard]] std::string constants_section(const Certificate& certificate);

/// The quantities that the constants bound, evaluated along the simulated trajectory.
[[nodiscard]] std::string audit_section(const Certificate& certificate);

}  // namespace veritrack::certificates
