#include "papers/ledger/ledger_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "certificates/document/markdown_text.hpp"

namespace veritrack::reports::ledger {

namespace {

using enum theorems::Paper;
using rigor::Verdict;
using theorems::FindingKind;
using theorems::Paper;
using theorems::PaperRole;

using Choice = std::function<bool(const Row& row)>;

std::size_t count(const std::vector<Row>& rows, const Choice& choice) {
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), choice));
}

bool is_open(const Row& row) {
  return !row.is_illegible() && !row.stands() && !row.falls();
}

std::string_view words_of(PaperRole role) {
  switch (role) {
    case PaperRole::sentence:
      return "asserted";
    case PaperRole::hypothesis:
      return "assumed, asked of the publication's own designs";
    case PaperRole::repair:
      return "ours, in place of what is printed";
  }
  return "";
}

/// The rows of one paper in one role, by verdict.
std::vector<std::string> count_row(const std::vector<Row>& rows, Paper paper, PaperRole role) {
  const auto of = [&](const Choice& choice) {
    return std::to_string(count(rows, [&](const Row& row) {
      return row.place.paper == paper && row.place.role == role && choice(row);
    }));
  };
  return {std::string(to_string(paper)),
          std::string(words_of(role)),
          of([](const Row&) { return true; }),
          of([](const Row& row) { return row.stands(); }),
          of([](const Row& row) { return row.falls() && row.is_uniform(); }),
          of([](const Row& row) { return !row.is_illegible() && row.is_everywhere(Verdict::undecided); }),
          of([](const Row& row) { return !row.is_uniform(); }),
          of([](const Row& row) { return row.is_illegible(); })};
}

}  // namespace

std::span<const SummaryLine> summary_lines() {
  static const std::vector<SummaryLine> lines{
#include "papers/ledger/ledger_summary.def"
  };
  return lines;
}

std::string summary(const std::vector<Row>& rows) {
  std::vector<std::vector<std::string>> lines;
  for (const SummaryLine& line : summary_lines()) {
    lines.push_back({std::string(line.publication), std::string(line.stands), std::string(line.falls),
                     line.repair.empty() ? "–" : std::string(line.repair)});
  }
  const auto asserted = [&](bool (Row::*is)() const) {
    return count(rows, [&](const Row& row) { return row.place.role == PaperRole::sentence && (row.*is)(); });
  };
  return fmt::format(
      "**{} of the sentences that the publications assert are PROVED and {} REFUTED; {} claims are open.** "
      "The results that engineers take from these publications survive. The failures are mostly a constant, "
      "a sign or a missing assumption, and one thing that matters: a guarantee with numbers, which the "
      "certificates of this program replace.\n\n{}\n",
      asserted(&Row::stands), asserted(&Row::falls), count(rows, is_open),
      certificates::markdown::table({"Publication", "What stands", "What falls", "In its place"}, lines));
}

std::string count_sentences(const std::vector<Row>& rows) {
  const auto in_role = [&](PaperRole role, const Choice& choice) {
    return count(rows, [&](const Row& row) { return row.place.role == role && choice(row); });
  };
  const auto of_kind = [&](FindingKind kind) {
    return count(rows, [&](const Row& row) { return row.finding != nullptr && row.finding->kind == kind; });
  };
  const auto all = [](const Row&) { return true; };
  const auto stands = [](const Row& row) { return row.stands(); };
  const auto falls = [](const Row& row) { return row.falls(); };
  return fmt::format(
      "{} claims of the publications are decided here, {} more are open, and {} cannot be read in the scan. "
      "The "
      "publications assert {} of them: {} are PROVED for every design, {} are REFUTED for at least one. The "
      "other {} are hypotheses of theorems, asked of the designs that the publications print: {} are PROVED "
      "for "
      "every design, {} are REFUTED for at least one. {} of the REFUTED sentences are false as stated, "
      "{} need an assumption that is not stated, {} are slips without consequence; the others fail for "
      "numbers "
      "that are printed. {} sentences of ours stand beside those that they repair. REFUTED is about a "
      "sentence "
      "as it is printed, and mostly about its constants.\n\n",
      count(rows,
            [](const Row& row) {
              return row.place.role != PaperRole::repair && (row.stands() || row.falls());
            }),
      count(rows, is_open), of_kind(FindingKind::illegible), in_role(PaperRole::sentence, all),
      in_role(PaperRole::sentence, stands), in_role(PaperRole::sentence, falls),
      in_role(PaperRole::hypothesis, all), in_role(PaperRole::hypothesis, stands),
      in_role(PaperRole::hypothesis, falls), of_kind(FindingKind::false_as_stated),
      of_kind(FindingKind::needs_unstated_assumption), of_kind(FindingKind::slip_without_consequence),
      in_role(PaperRole::repair, all));
}

std::string counts_table(const std::vector<Row>& rows) {
  std::vector<std::vector<std::string>> lines;
  for (const Paper paper : theorems::kAllPapers) {
    for (const PaperRole role : {PaperRole::sentence, PaperRole::hypothesis, PaperRole::repair}) {
      std::vector<std::string> line = count_row(rows, paper, role);
      if (line[2] != "0") {
        lines.push_back(std::move(line));
      }
    }
  }
  return certificates::markdown::table({"Publication", "What is", "Claims", "PROVED", "REFUTED", "UNDECIDED",
                                        "depends on the design", "illegible"},
                                       lines);
}

}  // namespace veritrack::reports::ledger
