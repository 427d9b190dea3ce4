// The checker's findings, in words and as JSON.
#pragma once

#include <string>

#include "checker/document/parts.hpp"

namespace veritrack::checker {

/// A line for each part, the sentences of the block at the top of the document, the design that they are
/// about, and VERIFIED or NOT VERIFIED.
std::string to_text(const Verification& found);

/// Everything: parts with their objections, all sentences, the requirements. UTF-8, two spaces a level.
std::string to_json(const Verification& found);

}  // namespace veritrack::checker
