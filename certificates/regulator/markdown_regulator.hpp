// The document of a regulator.
#pragma once

#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"

namespace veritrack::certificates {

/// The guarantee.
[[nodiscard]] std::vector<const Claim*> regulator_answers(const Certificate& certificate);

/// Plant, output, the simulated loop, and the tracker's own sections one level below.
[[nodiscard]] std::string regulator_sections(const Certificate& certificate, const MarkdownOptions& options);

}  // namespace veritrack::certificates
