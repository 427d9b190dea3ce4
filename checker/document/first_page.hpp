// The top of a document: the hypotheses, each once, and each sentence with the numbers of the hypotheses that
// it rests on.
#pragma once

#include <string>
#include <vector>

#include "checker/document/parts.hpp"

namespace veritrack::checker {

/// "PROVED".
std::string word_of(Verdict verdict);

/// The lines that a document has at its top, without empty ones and reasons: "**Assume**", the hypotheses,
/// "**Then**" and the sentences that name theirs; then the other sentences. Includes only sentences that
/// belong there.
std::vector<std::string> first_page(const std::vector<Sentence>& sentences);

/// Objects unless these lines, from the headline to the first section, say that, and contain nothing but
/// reasons between its first and last line or right behind it. Undecided sentences may stand before it.
void check_first_page(const std::vector<std::string>& lines, const std::vector<std::string>& expected,
                      Objections& objections);

}  // namespace veritrack::checker
