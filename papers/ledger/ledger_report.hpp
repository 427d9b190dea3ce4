// The ledger as a report: the claims of the publications that stand, those that fall, and what is proved in
// their place.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "papers/ledger/ledger.hpp"
#include "papers/reproductions/reproduction.hpp"
#include "reports/page/renderings.hpp"

namespace veritrack::reports::ledger {

/// The findings of one report of `veritrack reproduce` about a publication's printed simulations.
struct SimulatedReport {
  std::string name;
  int runs = 0;
  std::vector<Entry> entries;
};

/// All of them; `runs` seeds for each, or its own number when that is 0. Takes minutes.
[[nodiscard]] std::vector<SimulatedReport> simulate_reports(int runs,
                                                            const ReproductionProgress& progress = {});

/// Every decided claim: what falls, what stands, and the rows by publication.
[[nodiscard]] std::string decided_sections(const std::vector<Row>& rows);

/// The document: a summary of one page, every decided claim, and every simulated number.
[[nodiscard]] std::string ledger_document(const std::vector<Row>& rows,
                                          const std::vector<SimulatedReport>& simulated);

/// Writes report.md and the requested files into `directory`, whole or not at all. Throws
/// certificates::OutputError when files cannot be written.
[[nodiscard]] WrittenReport write_ledger(int runs, const std::filesystem::path& directory,
                                         const page::Renderings& renderings = {},
                                         const ReproductionProgress& progress = {});

}  // namespace veritrack::reports::ledger
