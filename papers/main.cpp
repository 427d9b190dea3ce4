// veritrack-reproduce, which carries out `veritrack reproduce`: the reports of docs/reports.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/program.hpp"
#include "cli/progress_line.hpp"
#include "cli/reproduce_options.hpp"
#include "papers/ledger/ledger_report.hpp"
#include "papers/reproductions/reproduction.hpp"

namespace {

namespace cli = veritrack::cli;
namespace reports = veritrack::reports;

/// Above the other reports: it collects what they find.
constexpr std::string_view kLedger = "ledger";

std::vector<std::pair<std::string, std::string>> names_of_reports() {
  std::vector<std::pair<std::string, std::string>> names;
  for (const reports::Reproduction& report : reports::reproductions()) {
    names.emplace_back(report.name, report.about);
  }
  names.emplace_back(kLedger, "every claim of the publications, decided or simulated");
  return names;
}

reports::WrittenReport write_report(const cli::ReproduceOptions& options, bool quiet) {
  const std::filesystem::path folder = options.directory.empty()
                                           ? std::filesystem::path("reports-out") / options.report
                                           : std::filesystem::path(options.directory);
  const cli::ProgressLine line(quiet, "simulating");
  const auto tell = [&](int done, int most) { line(done, most, "simulated"); };
  if (options.report == kLedger) {
    return reports::ledger::write_ledger(options.seeds, folder, options.renderings, tell);
  }
  const reports::Reproduction& report = reports::find_reproduction(options.report);
  return report.write(options.seeds > 0 ? options.seeds : report.runs, folder, options.renderings, tell);
}

int run(int argc, char** argv) {
  CLI::App app{
      "Regenerates a report of docs/reports: printed tables and figures beside our simulations, or the "
      "ledger "
      "of published claims.",
      "veritrack reproduce"};
  cli::ReproduceOptions options;
  add_reproduce_options(app, options, names_of_reports());
  bool quiet = false;
  app.add_flag("--quiet", quiet)->group("");  // an option of all commands, which veritrack explains
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? cli::all_proved : cli::bad_input;
  }
  if (!cli::trusts_arithmetic()) {
    return cli::bad_arithmetic;
  }
  const reports::WrittenReport written = write_report(options, quiet);
  if (!written.warning.empty()) {
    fmt::print(stderr, "{}: {}\n", written.document.string(), written.warning);
  }
  fmt::print("{}\n", written.document.string());
  return cli::all_proved;
}

}  // namespace

int main(int argc, char** argv) {
  return cli::run_program(argc, argv, run);
}
