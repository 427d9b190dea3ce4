#include "analysis/statements/paper_findings.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <string_view>

#include "tests/support/golden.hpp"

namespace {

using namespace veritrack;
using rigor::Verdict;
using theorems::FindingKind;

}  // namespace

TEST_CASE("each line of the ledger is there once, with a place and a kind") {
  std::set<std::string_view> claims;
  for (const theorems::PaperFinding& finding : theorems::paper_findings()) {
    CAPTURE(finding.claim);
    CHECK(claims.insert(finding.claim).second);
    CHECK_FALSE(finding.place.empty());
    CHECK_FALSE(to_string(finding.kind).empty());
  }
}

TEST_CASE("the page on published results has the whole ledger") {
  const std::string page = test::read_file(VERITRACK_SOURCE_DIR "/docs/published-results.md");
  for (const theorems::PaperFinding& finding : theorems::paper_findings()) {
    const std::string line = "| `" + std::string(finding.claim) + "` | " +
                             std::string(to_string(finding.kind)) + " | " + std::string(finding.place) + " |";
    CHECK_MESSAGE(page.find(line) != std::string::npos, line);
  }
}

TEST_CASE("a line of the ledger is found by the id, or by the id without its reading") {
  const auto kind_of = [](const char* claim) { return theorems::find_paper_finding(claim)->kind; };
  CHECK(kind_of("theorem-2.9/final-bound/errata") == FindingKind::slip_without_consequence);
  CHECK(kind_of("theorem-3.1/to-the-letter/gram-entry") == FindingKind::illegible);
  CHECK(theorems::find_paper_finding("theorem-2.9/R_x") == nullptr);
  CHECK(theorems::find_paper_finding("") == nullptr);
}

TEST_CASE("what is illegible in the scan is undecided, whatever our reading of it") {
  for (const Verdict reading : {Verdict::proved, Verdict::refuted, Verdict::undecided}) {
    theorems::Derivation derivation;
    derivation.id = "theorem-3.1/to-the-letter";
    derivation.conditions.push_back({"gram-entry", "0 \\le -1", reading, {}, {}, "0 is at least 0."});
    derivation.conditions.push_back({"definition-3.1", "0 < 0", Verdict::refuted, {}, {}, "0 is at most 0."});
    theorems::cite_findings(derivation);
    const theorems::Condition& illegible = derivation.conditions.front();
    CHECK(illegible.verdict == Verdict::undecided);
    CHECK(illegible.reason.starts_with("Illegible in the scan (thesis, section 3.2.1"));
    CHECK((illegible.reason.find("would be false") != std::string::npos) == (reading == Verdict::refuted));
    CHECK((illegible.reason.find("would be true") != std::string::npos) == (reading == Verdict::proved));
    CHECK(derivation.conditions.back().verdict == Verdict::refuted);
  }
}
