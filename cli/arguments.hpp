// The command line: the commands with their options, and help for each.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/reproduce_options.hpp"

namespace veritrack::cli {

/// The options of all commands.
struct Arguments {
  CertifyOptions certify;
  CheckOptions check;
  DiffOptions diff;
  MapOptions map;
  ShowOptions show;
  TieOptions tie;
  TuneOptions tune;
  TrackOptions track;
  ReproduceOptions reproduce;
  std::vector<std::string> sweep;  ///< the words
  ExplainOptions explain;
  NewOptions new_design;
  std::string shell;  ///< of completions
};

/// Adds the commands, which read their options into `into`; it must outlive the app. Each has examples in its
/// help.
void add_commands(CLI::App& app, Arguments& into);

}  // namespace veritrack::cli
