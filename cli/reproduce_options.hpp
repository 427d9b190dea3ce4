// The options of `veritrack reproduce`, which two programs know: the one that carries it out, and the one
// whose manual page and completions have them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "reports/page/renderings.hpp"

namespace veritrack::cli {

struct ReproduceOptions {
  reports::page::Renderings renderings;
  std::string report;
  std::string directory;
  int seeds = 0;  ///< 0: the number used for the report in docs/reports
};

/// `reports`: their names and subjects, the first the default; empty where they are not known.
void add_reproduce_options(CLI::App& command, ReproduceOptions& into,
                           const std::vector<std::pair<std::string, std::string>>& reports = {});

/// --html (which writes that page), --csv and --latex.
void add_renderings(CLI::App& command, const std::string& page, reports::page::Renderings& into);

}  // namespace veritrack::cli
