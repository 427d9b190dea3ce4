// The ledger as a report: what of the publications stands, what falls, what is proved in its place.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/ledger/ledger.hpp"
#include "reports/page/renderings.hpp"
#include "reports/written_report.hpp"

namespace veritrack::reports::ledger {

/// The document: a summary of one page, then every row, by publication.
[[nodiscard]] std::string ledger_document(const std::vector<Row>& rows);

/// report.md and what is asked for into `directory`, whole or not at all. Throws certificates::OutputError
/// when files cannot be written.
[[nodiscard]] WrittenReport write_ledger(const std::filesystem::path& directory,
                                         const page::Renderings& renderings = {},
                                         const Progress& progress = {});

}  // namespace veritrack::reports::ledger
