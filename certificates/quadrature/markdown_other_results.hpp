// The parts of published-theorems.md about the results beside Theorem 2.9.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// A short section for each result: its conditions with their verdicts, and remarks for the reader. Empty
/// when there are none.
[[nodiscard]] std::string other_results_section(const Certificate& certificate);

/// Their constants, one table for each result. Empty when there are none.
[[nodiscard]] std::string other_constants_section(const Certificate& certificate);

}  // namespace veritrack::certificates
