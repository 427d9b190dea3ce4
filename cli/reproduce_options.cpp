#include "cli/reproduce_options.hpp"

#include <fmt/format.h>

namespace veritrack::cli {

void add_renderings(CLI::App& command, const std::string& page, reports::page::Renderings& into) {
  command.add_flag("--html", into.html,
                   "also write " + page + ", one page with everything in it, which fetches nothing");
  command.add_flag("--csv", into.csv, "also write the data of every figure as CSV, beside it");
  command.add_flag("--latex", into.latex, "also write the tables of the document for LaTeX");
}

void add_reproduce_options(CLI::App& command, ReproduceOptions& into,
                           const std::vector<std::pair<std::string, std::string>>& reports) {
  std::string about = "which report";
  std::vector<std::string> names;
  for (const auto& [name, subject] : reports) {
    about += fmt::format("{} {} ({})", names.empty() ? ":" : ";", name, subject);
    names.push_back(name);
  }
  CLI::Option* report = command.add_option(
      "REPORT", into.report, names.empty() ? "which report; veritrack reproduce --help lists them" : about);
  if (!names.empty()) {
    into.report = names.front();
    report->check(CLI::IsMember(names))->capture_default_str();
  }
  command.add_option("--out", into.directory,
                     "folder for the report (default: reports-out/<name of the report>)");
  command.add_option("--seeds", into.seeds, "noise seeds (default: those of docs/reports)")
      ->check(CLI::Range(1, 100000));
  add_renderings(command, "report.html", into.renderings);
  command.footer(
      "Examples:\n"
      "  veritrack reproduce bittanti-savaresi-2000\n"
      "  veritrack reproduce tracking-limits --seeds 10\n"
      "  veritrack reproduce ledger");
}

}  // namespace veritrack::cli
