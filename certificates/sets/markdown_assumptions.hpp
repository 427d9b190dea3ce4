// Sections of certificate.md for the trackers whose errors a contraction certificate bounds.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// The assumptions on the signal and the start. `covariance`: P(0|0) in words, where the design leaves it to
/// the certificate.
[[nodiscard]] std::string assumptions_section(const Assumptions& assume, const std::string& covariance = "");

/// The simulated run with its figures. Empty without figures.
[[nodiscard]] std::string simulated_run_section(const Certificate& certificate, const SimulationSettings& run,
                                                const MarkdownOptions& options);

}  // namespace veritrack::certificates
