// The top of a document as a list: the hypotheses, each once and numbered, and then each claim with the
// numbers of the hypotheses that it rests on. The checker composes the same list from the sentences that it
// establishes (checker/document/first_page.hpp).
#pragma once

#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// Markdown: claims that are undecided first, each as a sentence with the reason why not; then "Assume" and
/// "Then" with those that are decided and name their hypotheses; then the others as sentences. Throws
/// std::logic_error where the statement of a claim does not begin with its hypotheses.
[[nodiscard]] std::string first_page(const std::vector<const Claim*>& claims);

}  // namespace veritrack::certificates
