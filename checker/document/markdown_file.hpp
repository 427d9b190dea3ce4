// The document beside a certificate: does it state what was verified?
#pragma once

#include <string>

#include "checker/document/parts.hpp"

namespace veritrack::checker {

/// The first line of the document on published theorems.
constexpr const char* kPublishedHeadline = "# What published theorems say of this design";

/// The heading of the section in which a document repeats every sentence that the checker establishes.
constexpr const char* kSectionOfTheChecker = "## What the checker verifies";

/// The first line of a document: the requirements and their verdict.
std::string headline(const Verification& verified);

/// Objects unless the document names the SHA-256 of the certificate and begins with the headline; its lines
/// and rows that give a verdict in the block at the top, under "What was required" and in the section of the
/// checker are exactly the sentences that were established; and the words PROVED and REFUTED stand nowhere
/// else, apart from the text of the design file at its end. Sentences on publications are in a document of
/// their own, which begins with kPublishedHeadline and has no other sentences; it has no block and no
/// requirements.
void compare_with_markdown(const Verification& verified, const std::string& certificate_sha256,
                           const std::string& document, Objections& objections);

}  // namespace veritrack::checker
