// certificate.md of a model: the parts above and below what was required.
#pragma once

#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"

namespace veritrack::certificates {

/// The decided claims that are not required.
[[nodiscard]] std::vector<const Claim*> model_answers(const Certificate& certificate);
/// States that there are none, where that is so.
[[nodiscard]] std::string model_remarks(const Certificate& certificate);

/// The design, the certified sets, bias and ripple, the recursion, and what is covered. Runs the attack of
/// analysis/model/set/falsifier.hpp once. Sets its own rounding mode.
[[nodiscard]] std::string model_sections(const Certificate& certificate, const MarkdownOptions& options);

}  // namespace veritrack::certificates
