// certificate.md of a model: what stands above what was required, and below it.
#pragma once

#include <string>

#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"

namespace veritrack::certificates {

/// What is told and PROVED, a line each; or that nothing is.
[[nodiscard]] std::string model_summary(const Certificate& certificate);

/// The design, the certified sets, bias and ripple, the recursion, and what is covered. Runs the attack of
/// analysis/model/falsifier.hpp once. Sets its own rounding mode.
[[nodiscard]] std::string model_sections(const Certificate& certificate, const MarkdownOptions& options);

}  // namespace veritrack::certificates
