// The ledger of slips: what kind of mistake a REFUTED statement about a paper is, and where in the paper it
// stands.
//
// REFUTED means that a sentence is false. It does not say how much that matters, nor, with a scan, whether
// the authors wrote the sentence. The ledger says both, once for each place; a test checks that it has every
// statement about a paper that can be REFUTED.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/statements/derivation.hpp"
#include "analysis/statements/statement.hpp"

namespace veritrack::theorems {

enum class FindingKind {
  false_as_stated,            ///< the sentence is false, and what rests on it needs another argument
  slip_without_consequence,   ///< the sentence is false; the correction is obvious, or the conclusion stands
  needs_unstated_assumption,  ///< true under an assumption that the place does not state
  illegible                   ///< the scan does not show what is printed, or leaves more than one reading
};

/// "false as stated", "slip without consequence", "needs an assumption that is not stated", "illegible".
[[nodiscard]] std::string_view to_string(FindingKind kind);

/// One line of the ledger.
struct PaperFinding {
  /// The id of a statement, "derivation/condition", or either without its last part, which stands for all
  /// readings.
  std::string_view claim;
  FindingKind kind;
  std::string_view place;  ///< in the paper, e.g. "thesis, section 3.2.1"
};

/// The whole ledger, in the order of the papers.
[[nodiscard]] const std::vector<PaperFinding>& paper_findings();

/// The line for a claim: that of its id, else that of its id without the last part; null when there is none.
[[nodiscard]] const PaperFinding* find_paper_finding(std::string_view claim);

/// Puts kind and place before the reason of every REFUTED statement, or condition, that the ledger has. An
/// illegible statement becomes UNDECIDED, whatever the verdict on our reading; the reason gives that verdict.
void cite_findings(std::vector<Statement>& statements);
void cite_findings(Derivation& derivation);

}  // namespace veritrack::theorems
