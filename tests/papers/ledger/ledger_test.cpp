#include "papers/ledger/ledger.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "certificates/document/tracker_kind.hpp"
#include "certificates/help/texts.hpp"
#include "papers/ledger/ledger_report.hpp"
#include "papers/ledger/ledger_summary.hpp"
#include "papers/ledger/published_designs.hpp"
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

/// Is it called where the column's certificates add published results?
bool is_published_result(const std::string& column, const std::string& call) {
  const std::filesystem::path folder(VERITRACK_SOURCE_DIR "/certificates/" + column);
  if (!std::filesystem::is_directory(folder)) {
    return false;
  }
  const auto files = std::filesystem::directory_iterator(folder);
  return std::any_of(begin(files), end(files), [&](const auto& file) {
    const std::string text = file.path().extension() == ".cpp" ? test::read_file(file.path().string()) : "";
    return text.find("void " + column + "_published_results(") != std::string::npos &&
           text.find(call) != std::string::npos;
  });
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
    return !row.is_illegible() && !row.falls() && !row.stands();
  });
  CHECK(20 * open <= static_cast<std::ptrdiff_t>(ledger_rows().size()));
}

TEST_CASE("what the scan does not show counts neither as proved nor as refuted") {
  const auto illegible = std::count_if(ledger_rows().begin(), ledger_rows().end(),
                                       [](const Row& row) { return row.is_illegible(); });
  CHECK(illegible == 2);
  const std::string document = reports::ledger::ledger_document(ledger_rows(), {});
  for (const char* claim : {"kkl-paper/phase-formula", "theorem-3.1/to-the-letter/gram-entry"}) {
    CAPTURE(claim);
    const Row& row = row_of(claim);
    CHECK(row.is_illegible());
    CHECK(row.is_everywhere(Verdict::undecided));
    CHECK_FALSE(row.falls());
    CHECK_FALSE(row.stands());
    const std::size_t at = document.find("| `" + std::string(claim) + "` |");
    REQUIRE(at != std::string::npos);
    const std::string line = document.substr(at, document.find('\n', at) - at);
    CHECK(line.find("*illegible*") != std::string::npos);
    CHECK(line.find("**REFUTED**") == std::string::npos);
  }
  CHECK(document.find("2 cannot be read in the scan") != std::string::npos);
}

TEST_CASE("every function that decides sentences of a publication is in the ledger") {
  const std::regex declaration(R"(std::vector<(?:theorems::)?Statement>\s+(\w+)\(\);)");
  const std::string ledger = test::read_file(VERITRACK_SOURCE_DIR "/papers/ledger/ledger.cpp");
  std::set<std::string> names;
  for (const char* floor : {"/analysis", "/papers"}) {
    for (const auto& file :
         std::filesystem::recursive_directory_iterator(VERITRACK_SOURCE_DIR + std::string(floor))) {
      if (file.path().extension() != ".hpp") {
        continue;
      }
      const std::string text = test::read_file(file.path().string());
      const std::string folder = file.path().parent_path().filename().string();
      const std::string column = folder == "claims" ? "theorems" : folder;
      for (std::sregex_iterator found(text.begin(), text.end(), declaration), end; found != end; ++found) {
        const std::string call = column + "::" + (*found)[1].str() + "()";
        CAPTURE(call);
        CHECK(names.insert(call).second);
        // In the ledger itself, or by the certificates of the publication's designs.
        CHECK((ledger.find("collection.add(" + call + ");") != std::string::npos ||
               is_published_result(column, call)));
      }
    }
  }
  CHECK(names.size() >= 17);
}

TEST_CASE("every publication has rows, and every kind of tracker that a publication is about has a design") {
  std::map<theorems::Paper, int> sentences;
  for (const Row& row : ledger_rows()) {
    sentences[row.place.paper] += row.place.role == PaperRole::sentence ? 1 : 0;
  }
  for (const theorems::Paper paper : theorems::kAllPapers) {
    CAPTURE(to_string(paper));
    const bool is_first_page =
        paper == theorems::Paper::kang_song_lee || paper == theorems::Paper::guan_chen_ueta;
    CHECK(sentences[paper] >= (is_first_page || paper == theorems::Paper::cited ? 1 : 10));
  }
  for (const certificates::TrackerKind* kind : certificates::tracker_kinds()) {
    const std::string key = "tracker = \"" + std::string(kind->name) + '"';
    const auto& designs = reports::ledger::published_designs();
    CAPTURE(key);
    CHECK((kind->published_results == nullptr ||
           std::any_of(designs.begin(), designs.end(), [&](const certificates::EmbeddedText& design) {
             return design.text.find(key) != std::string::npos;
           })));
  }
}

TEST_CASE("every claim is counted in one column of the summary") {
  const std::string document = reports::ledger::ledger_document(ledger_rows(), {});
  std::size_t at = document.find("| Publication | What is | Claims |");
  REQUIRE(at != std::string::npos);
  at = document.find('\n', document.find('\n', at) + 1) + 1;  // past the heads
  int rows = 0;
  for (; document[at] == '|'; at = document.find('\n', at) + 1, ++rows) {
    std::istringstream line(document.substr(at, document.find('\n', at) - at));
    std::vector<int> counts;
    for (std::string cell; std::getline(line, cell, '|');) {
      if (cell.find_first_not_of(" 0123456789") == std::string::npos &&
          cell.find_first_of("0123456789") != std::string::npos) {
        counts.push_back(std::stoi(cell));
      }
    }
    CAPTURE(document.substr(at, 60));
    REQUIRE(counts.size() == 6);
    CHECK(counts[0] == counts[1] + counts[2] + counts[3] + counts[4] + counts[5]);
  }
  CHECK(rows > 8);
}

TEST_CASE("the summary is a page, has every publication, and what it says is in the rows") {
  std::set<theorems::Paper> papers;
  for (const reports::ledger::SummaryLine& line : reports::ledger::summary_lines()) {
    CAPTURE(line.publication);
    papers.insert(line.paper);
    CHECK_FALSE(line.proved.empty());
    CHECK(line.refuted.empty() == (line.falls == "Nothing."));
    CHECK(line.repair.empty() == line.refuted.empty());
    for (const std::string_view claim : line.proved) {
      CAPTURE(claim);
      CHECK(row_of(std::string(claim)).stands());
      CHECK(row_of(std::string(claim)).place.paper == line.paper);
    }
    for (const std::string_view claim : line.refuted) {
      CAPTURE(claim);
      CHECK(row_of(std::string(claim)).falls());
      CHECK(row_of(std::string(claim)).place.paper == line.paper);
    }
  }
  CHECK(papers.size() == theorems::kAllPapers.size());
  const std::string page = reports::ledger::summary(ledger_rows());
  CHECK(std::count(page.begin(), page.end(), ' ') < 700);
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
