// Sections of certificate.md for the trackers whose errors a contraction certificate bounds.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// What is assumed of the signal and the start.
[[nodiscard]] std::string assumptions_section(const Assumptions& assume);

/// The simulated run with its figures. Empty without figures.
[[nodiscard]] std::string simulated_run_section(const Certificate& certificate, const SimulationSettings& run,
                                                const MarkdownOptions& options);

}  // namespace veritrack::certificates
