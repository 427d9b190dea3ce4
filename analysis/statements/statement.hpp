// A statement about a published theorem or about a design, decided by interval arithmetic.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/statements/derivation.hpp"

namespace veritrack::theorems {

/// One statement with its verdict. PROVED and REFUTED refer to the sentence as written.
struct Statement {
  std::string id;        ///< e.g. "theorem-2.9/b_1/errata"
  std::string sentence;  ///< plain text, with units where there are any
  rigor::Verdict verdict = rigor::Verdict::undecided;
  std::string witness;  ///< one line that can be evaluated again: the point or set, and the two sides there
  std::vector<Quantity> evidence;  ///< the enclosures that decided it
  /// Decimals in the sentence, by name, where the id alone does not determine the sentence.
  std::vector<std::pair<std::string, std::string>> values = {};
};

/// The statement, with evidence that is not finite marked as not applicable; the witness then says which
/// quantity is undefined, and the verdict is UNDECIDED.
[[nodiscard]] Statement make_statement(std::string id, std::string sentence, rigor::Verdict verdict,
                                       std::string witness, std::vector<Quantity> evidence);

}  // namespace veritrack::theorems
