#include "reports/ledger/ledger.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "reports/ledger/ledger_report.hpp"
#include "tests/support/golden.hpp"

namespace {

using namespace veritrack;
using reports::ledger::Row;
using rigor::Verdict;
using theorems::PaperRole;

const std::vector<Row>& ledger_rows() {
  static const std::vector<Row> rows = reports::ledger::collect();
  return rows;
}

const Row& row_of(const std::string& claim) {
  const auto& rows = ledger_rows();
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.claim == claim; });
  REQUIRE_MESSAGE(found != rows.end(), claim);
  return *found;
}

}  // namespace

TEST_CASE("each claim stands in the ledger once, with a place, words, a verdict and a ground") {
  std::set<std::string> claims;
  for (const Row& row : ledger_rows()) {
    CAPTURE(row.claim);
    CHECK(claims.insert(row.claim).second);
    CHECK_FALSE(row.place.place.empty());
    CHECK_FALSE(row.words.empty());
    REQUIRE_FALSE(row.verdicts.empty());
    for (const auto& each : row.verdicts) {
      CHECK_FALSE(each.design.empty());
      CHECK_FALSE(each.ground.empty());
    }
    CHECK_FALSE(consequence(row, ledger_rows()).empty());
  }
}

TEST_CASE("every finding in print has its rows, and what is ours is proved") {
  for (const theorems::PaperFinding& finding : theorems::paper_findings()) {
    CAPTURE(finding.claim);
    // Some are false for other designs only.
    CHECK(std::any_of(ledger_rows().begin(), ledger_rows().end(),
                      [&](const Row& row) { return theorems::find_paper_finding(row.claim) == &finding; }));
  }
  for (const Row& row : ledger_rows()) {
    CAPTURE(row.claim);
    CHECK((row.place.role != PaperRole::repair || row.is_everywhere(Verdict::proved)));
    // A sentence is refuted because it is wrong, or because of the numbers of section V.
    CHECK((row.place.role != PaperRole::sentence || !row.is_anywhere(Verdict::refuted) ||
           row.finding != nullptr || row.claim.starts_with("kkl-paper/")));
  }
}

TEST_CASE("at most one claim in twenty is open") {
  const auto open = std::count_if(ledger_rows().begin(), ledger_rows().end(), [](const Row& row) {
    return !row.is_anywhere(Verdict::refuted) && !row.is_everywhere(Verdict::proved);
  });
  CHECK(20 * open <= static_cast<std::ptrdiff_t>(ledger_rows().size()));
}

TEST_CASE("consequences name what is proved in place of what is false") {
  const auto of = [](const std::string& claim) { return consequence(row_of(claim), ledger_rows()); };
  CHECK(of("theorem-2.9/gramian-eigenvalue/printed") ==
        "what rests on it needs another argument; in its place: theorem-2.9/gramian-eigenvalue/repaired");
  CHECK(of("theorem-2.9/R_x") == "it stands");
  CHECK(of("theorem-2.9/printed/2.43").starts_with("the theorem says nothing about these designs"));
  CHECK(of("kkl-paper/phase-formula") == "none that can be decided from the scan");
  CHECK(of("proposition-1/denominator-printed").ends_with("proposition-1/denominator-corrected"));
}

TEST_CASE("the document has every claim and a summary with the numbers") {
  const std::string document = reports::ledger::ledger_document(ledger_rows(), {});
  for (const Row& row : ledger_rows()) {
    CHECK_MESSAGE(document.find("| `" + row.claim + "` |") != std::string::npos, row.claim);
  }
  CHECK(document.find("claims of the publications are decided here") != std::string::npos);
}

TEST_CASE("the page of docs/ has every decided claim as it is decided now") {
  // Made by: veritrack reproduce ledger --out docs/reports/ledger
  const std::string page = test::read_file(VERITRACK_SOURCE_DIR "/docs/reports/ledger/report.md");
  CHECK((page.find(reports::ledger::decided_sections(ledger_rows())) != std::string::npos));
}

TEST_CASE("what was simulated stands beside what is decided, as samples") {
  const reports::Entry entry{
      "paper/table/entry", "paper, table", "a number", "1.0", "≈ 1.02", reports::EntryVerdict::agrees, ""};
  const std::string document = reports::ledger::ledger_document(ledger_rows(), {{"a-report", 7, {entry}}});
  CHECK(document.find("They are samples and prove nothing.") != std::string::npos);
  CHECK(document.find("7 runs; derived again by `veritrack reproduce a-report`") != std::string::npos);
  CHECK(document.find("paper/table/entry") != std::string::npos);
}

TEST_CASE("what the summary says in words is in the rows") {
  for (const char* stands : {"theorem-3.1/rank", "kkl-paper/injectivity", "table-3.1/errata/alpha-q1",
                             "table-3.1/errata/beta-q2", "table-3.1/errata/alpha-r", "proposition-1/if"}) {
    CAPTURE(stands);
    CHECK(row_of(stands).is_everywhere(Verdict::proved));
  }
  CHECK(row_of("theorem-2.9/printed/2.43").is_everywhere(Verdict::refuted));
  CHECK(row_of("theorem-2.9/errata/2.43").is_everywhere(Verdict::refuted));
}
