// The parts of published-theorems.md about the results beside Theorem 2.9.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// A short section a result: its conditions with their verdicts, and what a reader needs to know. Empty when
/// there are none.
[[nodiscard]] std::string other_results_section(const Certificate& certificate);

/// Their constants, a table a result. Empty when there are none.
[[nodiscard]] std::string other_constants_section(const Certificate& certificate);

}  // namespace veritrack::certificates
