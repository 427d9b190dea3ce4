// The reports of `veritrack reproduce`: one record for each, in a list.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "papers/reproductions/entry.hpp"
#include "papers/reproductions/written_report.hpp"
#include "reports/figures.hpp"
#include "reports/page/renderings.hpp"

namespace veritrack::reports {

/// Receives how many of how many pieces of work are done.
using ReproductionProgress = std::function<void(int, int)>;

/// The result of a reproduction: the rows that a ledger collects, and the document about them.
struct Findings {
  std::vector<Entry> entries;
  std::string markdown;
  std::vector<Figure> figures;
};

/// Writes report.md, its figures and the requested files into `directory`, whole or not at all. Throws
/// FigureError, and certificates::OutputError when files cannot be written.
[[nodiscard]] WrittenReport write_findings(Findings findings, int runs,
                                           const std::filesystem::path& directory,
                                           const page::Renderings& renderings);

/// A report: its name on the command line, its subject (after "the"), and the function that writes it. `runs`
/// is the number of noise seeds of docs/reports.
struct Reproduction {
  std::string_view name;
  std::string_view about;
  int runs;
  WrittenReport (*write)(int runs, const std::filesystem::path& directory, const page::Renderings& renderings,
                         const ReproductionProgress& progress);
  /// The written result, where the report compares printed numbers with ours; otherwise null.
  Findings (*reproduce)(int runs, const ReproductionProgress& progress) = nullptr;
};

/// All of them (papers/reproductions/reproduction.cpp); the first is the default.
[[nodiscard]] std::span<const Reproduction> reproductions();

/// Throws std::out_of_range.
[[nodiscard]] const Reproduction& find_reproduction(std::string_view name);

}  // namespace veritrack::reports
