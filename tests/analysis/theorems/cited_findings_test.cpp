#include <doctest/doctest.h>

#include <set>
#include <string>

#include "analysis/statements/paper_findings.hpp"
#include "analysis/theorems/other_results/other_results.hpp"
#include "analysis/theorems/theorem_2_9_gaps.hpp"
#include "tests/analysis/theorems/tracker_inputs.hpp"

namespace {

using namespace veritrack;
using rigor::Verdict;

/// The derivations whose conditions are sentences of a paper. The others' are hypotheses that a design may
/// fail.
const std::set<std::string> kSentences{"riccati-bounds",        "theorem-3.1", "theorem-3.1/to-the-letter",
                                       "theorem-3.2/any-start", "lemma-3.1",   "table-3.1/printed",
                                       "table-3.1/errata"};

bool begins_with_a_kind(const std::string& reason) {
  return reason.starts_with("False as stated (") || reason.starts_with("Slip without consequence (") ||
         reason.starts_with("Needs an assumption that is not stated (");
}

}  // namespace

TEST_CASE("every refuted statement about the thesis says what kind of mistake it is, and where") {
  test::Random random(77);
  for (std::int64_t i = 0; i < test::effort(40); ++i) {
    CAPTURE(i);
    const test::TestDesign design = i < 4 ? test::table_design(test::kTable32.at(static_cast<std::size_t>(i)))
                                          : test::random_design(random);
    const theorems::TrackerInput input = test::tracker_input(design);
    for (const theorems::Statement& statement : theorems::theorem_2_9_gaps(input.theorem_2_9)) {
      CAPTURE(statement.id);
      // R_x is a number of the design.
      CHECK(begins_with_a_kind(statement.witness) ==
            (statement.verdict == Verdict::refuted && statement.id != "theorem-2.9/R_x"));
    }
    for (const theorems::Derivation& derivation : theorems::evaluate_other_results(input)) {
      for (const theorems::Condition& condition : derivation.conditions) {
        CAPTURE(derivation.id);
        CAPTURE(condition.id);
        if (kSentences.contains(derivation.id)) {
          CHECK(begins_with_a_kind(condition.reason) == (condition.verdict == Verdict::refuted));
          CHECK(condition.reason.starts_with("Illegible in the scan (") == (condition.id == "gram-entry"));
        }
      }
    }
  }
}

TEST_CASE("each line of the ledger is about something") {
  const theorems::TrackerInput input = test::tracker_input(test::table_design(test::kTable32[0]));
  std::set<const theorems::PaperFinding*> used;
  for (const theorems::Statement& statement : theorems::theorem_2_9_gaps(input.theorem_2_9)) {
    used.insert(theorems::find_paper_finding(statement.id));
  }
  for (const theorems::Derivation& derivation : theorems::evaluate_other_results(input)) {
    for (const theorems::Condition& condition : derivation.conditions) {
      used.insert(theorems::find_paper_finding(derivation.id + "/" + condition.id));
    }
  }
  for (const theorems::PaperFinding& finding : theorems::paper_findings()) {
    const bool of_another_tracker =
        finding.claim.starts_with("proposition-") || finding.claim.starts_with("bittanti-savaresi/") ||
        finding.claim.starts_with("kkl-paper/") || finding.claim.starts_with("zarchan/") ||
        finding.claim.starts_with("paper-1996/") || finding.claim.starts_with("chapter-");
    CAPTURE(finding.claim);
    CHECK((of_another_tracker || used.contains(&finding)));
  }
}
