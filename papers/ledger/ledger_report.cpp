#include "papers/ledger/ledger_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "certificates/document/markdown_text.hpp"
#include "certificates/document/output_files.hpp"
#include "papers/ledger/ledger_summary.hpp"

namespace veritrack::reports::ledger {

namespace {

using certificates::markdown::escaped;
using rigor::Verdict;
using theorems::FindingKind;
using theorems::Paper;
using theorems::PaperRole;

/// "3.2, 3.4": the designs without the words that they all begin with.
std::string designs_with(const Row& row, Verdict verdict) {
  std::string_view common = row.verdicts.front().design;
  for (const DesignVerdict& each : row.verdicts) {
    const auto [end, other] =
        std::mismatch(common.begin(), common.end(), each.design.begin(), each.design.end());
    common = common.substr(0, static_cast<std::size_t>(end - common.begin()));
  }
  const std::size_t begin = common.rfind('-') + 1;
  std::string text;
  for (const DesignVerdict& each : row.verdicts) {
    if (each.verdict == verdict) {
      text += (text.empty() ? "" : ", ") + each.design.substr(begin);
    }
  }
  return text;
}

std::string verdict_cell(const Row& row) {
  if (row.is_illegible()) {
    return "*illegible*";
  }
  if (row.is_uniform()) {
    return certificates::markdown::verdict(row.verdicts.front().verdict);
  }
  std::string text;
  for (const Verdict verdict : {Verdict::proved, Verdict::refuted, Verdict::undecided}) {
    if (row.is_anywhere(verdict)) {
      text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", certificates::markdown::verdict(verdict),
                          designs_with(row, verdict));
    }
  }
  return text;
}

/// The ground without the kind of mistake and the place before it, which have columns of their own: a
/// sentence.
std::string without_finding(const Row& row, const std::string& ground) {
  const std::string place = row.finding == nullptr ? "" : fmt::format(" ({}): ", row.finding->place);
  const std::size_t at = place.empty() ? std::string::npos : ground.find(place);
  std::string rest = at == std::string::npos ? ground : ground.substr(at + place.size());
  if (row.is_illegible() && !rest.empty()) {  // "as we read it, ..."
    rest.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(rest.front())));
  }
  return rest;
}

/// The ground for the strongest verdict: a refutation counts more than a proof, and that more than neither.
std::string ground_cell(const Row& row) {
  for (const Verdict verdict : {Verdict::refuted, Verdict::proved}) {
    const auto found = std::find_if(row.verdicts.begin(), row.verdicts.end(),
                                    [&](const DesignVerdict& each) { return each.verdict == verdict; });
    if (found != row.verdicts.end()) {
      return escaped(without_finding(row, found->ground));
    }
  }
  return escaped(without_finding(row, row.verdicts.front().ground));
}

/// Id, place, what it says, consequence: of the rows with that finding.
std::string finding_table(const std::vector<Row>& rows, FindingKind kind) {
  std::vector<std::vector<std::string>> lines;
  for (const Row& row : rows) {
    if (row.finding != nullptr && row.finding->kind == kind) {
      lines.push_back({escaped(row.place.place), row.words, ground_cell(row), consequence(row, rows)});
    }
  }
  return certificates::markdown::table({"Place", "What it says", "Ground", "Consequence"}, lines);
}

std::string falls_section(const std::vector<Row>& rows) {
  std::string text = "## What falls, and what is proved in its place\n\n";
  for (const FindingKind kind : {FindingKind::false_as_stated, FindingKind::needs_unstated_assumption,
                                 FindingKind::slip_without_consequence}) {
    std::string heading(to_string(kind));
    heading.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(heading.front())));
    text += fmt::format("### {}\n\n{}\n", heading, finding_table(rows, kind));
  }
  return text + "## What cannot be read in the scan\n\n" + finding_table(rows, FindingKind::illegible) + "\n";
}

std::string stands_section(const std::vector<Row>& rows) {
  std::vector<std::vector<std::string>> lines;
  for (const Row& row : rows) {
    if (row.place.role == PaperRole::sentence && row.stands()) {
      lines.push_back({escaped(row.place.place), row.words});
    }
  }
  return "## What stands\n\n" + certificates::markdown::table({"Place", "What it says"}, lines) + "\n";
}

/// Every design that the rows of a paper were evaluated for.
std::string designs_of(const std::vector<Row>& rows, Paper paper) {
  std::vector<std::string> designs;
  for (const Row& row : rows) {
    if (row.place.paper != paper) {
      continue;
    }
    for (const DesignVerdict& each : row.verdicts) {
      if (each.design != kNoDesign &&
          std::find(designs.begin(), designs.end(), each.design) == designs.end()) {
        designs.push_back(each.design);
      }
    }
  }
  std::string text;
  for (const std::string& design : designs) {
    text += fmt::format("{}`veritrack certify designs/{}.toml`", text.empty() ? "" : ", ", design);
  }
  const std::string ledger = "`veritrack reproduce ledger`";
  return text.empty() ? ledger : text + ", or, where no design enters, by " + ledger;
}

std::string paper_section(const std::vector<Row>& rows, Paper paper) {
  std::vector<std::vector<std::string>> lines;
  for (const Row& row : rows) {
    if (row.place.paper == paper) {
      lines.push_back({"`" + row.claim + "`", escaped(row.place.place), row.words, verdict_cell(row),
                       ground_cell(row), consequence(row, rows)});
    }
  }
  return fmt::format("### {}\n\nDerived again by {}.\n\n{}\n", to_string(paper), designs_of(rows, paper),
                     certificates::markdown::table(
                         {"Claim", "Place", "What it says", "Verdict", "Ground", "Consequence"}, lines));
}

/// The share of the statements on simulations that comes out.
std::string simulated_summary(const std::vector<SimulatedReport>& simulated) {
  std::vector<Entry> all;
  for (const SimulatedReport& report : simulated) {
    all.insert(all.end(), report.entries.begin(), report.entries.end());
  }
  return all.empty()
             ? ""
             : "Beside these stand the numbers and sentences that the publications print of their "
               "simulations, compared with simulations of ours. They are samples and prove nothing. " +
                   count_sentence(all) + "\n\n";
}

std::string simulated_section(const std::vector<SimulatedReport>& simulated) {
  std::string text;
  for (const SimulatedReport& report : simulated) {
    text +=
        fmt::format("### {}\n\n{} runs; derived again by `veritrack reproduce {}`. {}\n\n{}\n", report.name,
                    report.runs, report.name, count_sentence(report.entries), entry_table(report.entries));
  }
  return text.empty() ? text : "## Every printed number and sentence about simulations\n\n" + text;
}

}  // namespace

std::vector<SimulatedReport> simulate_reports(int runs, const ReproductionProgress& progress) {
  std::vector<SimulatedReport> simulated;
  const auto all = reproductions();
  int done = 0;
  for (const Reproduction& report : all) {
    if (report.reproduce != nullptr) {
      const int seeds = runs > 0 ? runs : report.runs;
      simulated.push_back({std::string(report.name), seeds, report.reproduce(seeds, {}).entries});
    }
    if (progress) {
      progress(++done, static_cast<int>(all.size()));
    }
  }
  return simulated;
}

std::string decided_sections(const std::vector<Row>& rows) {
  std::string text = falls_section(rows) + stands_section(rows) + "## Every claim\n\n";
  for (const Paper paper : theorems::kAllPapers) {
    text += paper_section(rows, paper);
  }
  return text;
}

std::string ledger_document(const std::vector<Row>& rows, const std::vector<SimulatedReport>& simulated) {
  return "# What the publications claim, decided\n\n" + summary(rows) + simulated_summary(simulated) +
         "## How it is decided, and how many\n\n" + count_sentences(rows) + counts_table(rows) +
         "\nPROVED and REFUTED are computed with outward-rounded interval arithmetic, or are identities "
         "evaluated exactly; UNDECIDED is everything else, and *illegible* is what the scan leaves open. A "
         "claim "
         "is evaluated for every design that its publication prints (the four of Table 3.2, both examples, "
         "section V); where the verdicts differ, the designs are named. The certificates of these designs "
         "hold "
         "the numbers, and `veritrack-verify` checks them. Places are those of the scans; what a scan has "
         "lost "
         "is not held against anybody.\n\n" +
         decided_sections(rows) + simulated_section(simulated);
}

WrittenReport write_ledger(int runs, const std::filesystem::path& directory,
                           const page::Renderings& renderings, const ReproductionProgress& progress) {
  const std::vector<SimulatedReport> simulated = simulate_reports(runs, progress);
  certificates::OutputFiles files;
  page::stage_document(files, directory, {"report", ledger_document(collect(), simulated)}, renderings);
  files.commit();
  return {directory / "report.md", ""};
}

}  // namespace veritrack::reports::ledger
