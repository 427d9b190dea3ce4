// The document of a block tracker's certificate.
#pragma once

#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "certificates/document/markdown.hpp"

namespace veritrack::certificates {

/// See TrackerKind.
[[nodiscard]] std::vector<const Claim*> dft_block_answers(const Certificate& certificate);
[[nodiscard]] std::string dft_block_sections(const Certificate& certificate, const MarkdownOptions& options);

}  // namespace veritrack::certificates
