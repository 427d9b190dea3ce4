#include "analysis/statements/statement.hpp"

#include <utility>

namespace veritrack::theorems {

Statement make_statement(std::string id, std::string sentence, rigor::Verdict verdict, std::string witness,
                         std::vector<Quantity> evidence) {
  Statement statement{std::move(id), std::move(sentence), verdict, std::move(witness), std::move(evidence)};
  for (Quantity& quantity : statement.evidence) {
    if (!is_finite(quantity.value)) {
      quantity.value = rigor::Interval::empty();
      quantity.not_applicable = quantity.name + " is undefined, or overflows, for the values of this design.";
      statement.verdict = rigor::Verdict::undecided;
      statement.witness = *quantity.not_applicable;
    }
  }
  return statement;
}

}  // namespace veritrack::theorems
