// certificate.md of a model: what stands above what was required, and below it.
#pragma once

#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"

namespace veritrack::certificates {

/// What is decided and not required.
[[nodiscard]] std::vector<const Claim*> model_answers(const Certificate& certificate);
/// That there is nothing of it, where there is not.
[[nodiscard]] std::string model_remarks(const Certificate& certificate);

/// The design, the certified sets, bias and ripple, the recursion, and what is covered. Runs the attack of
/// analysis/model/set/falsifier.hpp once. Sets its own rounding mode.
[[nodiscard]] std::string model_sections(const Certificate& certificate, const MarkdownOptions& options);

}  // namespace veritrack::certificates
