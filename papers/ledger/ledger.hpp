// The ledger: every claim of the publications that the program decides, evaluated for the publications' own
// designs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/rigor/verdict.hpp"
#include "analysis/statements/paper_findings.hpp"
#include "papers/claims/paper_places.hpp"

namespace veritrack::reports::ledger {

/// In place of a design, for claims that do not depend on one.
inline constexpr const char* kNoDesign = "none";

/// The result for one design.
struct DesignVerdict {
  /// Its file without folder and ending, e.g. "la-scala-1994-figure-3.5", or kNoDesign.
  std::string design;
  rigor::Verdict verdict = rigor::Verdict::undecided;
  std::string ground;  ///< a sentence, as the certificate has it
};

/// A claim of a publication.
struct Row {
  std::string claim;  ///< its id, as `veritrack explain` and the certificates have it
  theorems::PaperPlace place;
  std::string words;                    ///< the claim: plain text, or Markdown with a formula
  std::vector<DesignVerdict> verdicts;  ///< one for each design that it was evaluated for, never empty
  const theorems::PaperFinding* finding = nullptr;  ///< what mistake it is, or that it is illegible

  /// The same for all designs?
  [[nodiscard]] bool is_uniform() const;
  /// Is that the verdict for every design?
  [[nodiscard]] bool is_everywhere(rigor::Verdict verdict) const;
  /// Is it that for any design?
  [[nodiscard]] bool is_anywhere(rigor::Verdict verdict) const;

  /// Does the scan leave the printed text open? The claim is then UNDECIDED for every design, whatever the
  /// verdict on our reading (cite_findings).
  [[nodiscard]] bool is_illegible() const;
  /// PROVED for every design.
  [[nodiscard]] bool stands() const;
  /// REFUTED for at least one design.
  [[nodiscard]] bool falls() const;
};

/// All rows, by publication, those of one in the order of its certificates. Opens its own rounding scopes.
[[nodiscard]] std::vector<Row> collect();

/// The consequence of a verdict for the publication, in a few words; `rows` is the whole ledger, in which a
/// repaired reading of the same sentence may stand.
[[nodiscard]] std::string consequence(const Row& row, const std::vector<Row>& rows);

}  // namespace veritrack::reports::ledger
