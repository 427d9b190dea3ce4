// The command line: reads arguments and calls commands.hpp.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "certificates/design/input_error.hpp"
#include "certificates/design/nearest_key.hpp"
#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/hand_over.hpp"
#include "cli/program.hpp"
#include "cli/shell_words.hpp"
#include "cli/version.hpp"

namespace {

using namespace veritrack::cli;  // NOLINT(google-build-using-namespace): this file is made of it

/// The message when the first argument that is no option is no command; empty when it is one.
std::string unknown_command(CLI::App& app, int argc, char** argv) {
  const auto arguments = std::span(argv, static_cast<std::size_t>(argc));
  const auto first = std::find_if(arguments.begin() + 1, arguments.end(),
                                  [](const char* argument) { return *argument != '-'; });
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) {
    known.push_back(command->get_name());
  }
  if (first == arguments.end() || std::find(known.begin(), known.end(), *first) != known.end()) {
    return {};
  }
  constexpr std::size_t kShown = 100;
  return fmt::format("veritrack: no command is called \"{}\"; nearest command: {}; allowed: {}",
                     veritrack::certificates::printable(*first, kShown),
                     veritrack::certificates::nearest_key(*first, known), fmt::join(known, ", "));
}

/// The message on the first option that the command does not have; empty when it has all of them.
std::string unknown_option(CLI::App& app, int argc, char** argv) {
  const auto arguments = std::span(argv, static_cast<std::size_t>(argc)).subspan(1);
  std::vector<std::string> known;
  std::string command;
  const auto add_options = [&](const CLI::App& of) {
    for (const CLI::Option* option : of.get_options()) {
      for (const std::string& name : option->get_lnames()) {
        known.push_back("--" + name);
      }
    }
  };
  add_options(app);
  for (const CLI::App* each : app.get_subcommands()) {
    command = " " + each->get_name();
    add_options(*each);
  }
  for (const char* argument : arguments) {
    const std::string name = std::string(argument).substr(0, std::string(argument).find('='));
    if (name == "--") {
      break;
    }
    if (name.starts_with("--") && std::find(known.begin(), known.end(), name) == known.end()) {
      constexpr std::size_t kShown = 100;
      return fmt::format(
          "veritrack{0}: no option is called \"{1}\"; nearest option: {2}; allowed: what `veritrack{0} "
          "--help` lists",
          command, veritrack::certificates::printable(name, kShown),
          veritrack::certificates::nearest_key(name, known));
    }
  }
  return {};
}

int run(int argc, char** argv) {
  if (const auto words = words_after("reproduce", argc, argv)) {
    return run_reproduce(*words);
  }
  const auto sweep = words_after("sweep", argc, argv);
  if (sweep && !sweep->empty() && sweep->front() != "--help" && sweep->front() != "-h") {
    return run_sweep(*sweep);
  }
  CLI::App app{"Machine-checked certificates for frequency trackers.", "veritrack"};
  app.set_version_flag("--version", version_text, "print the version, and those of the libraries");
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 everything required is PROVED (or nothing is required); 1 something is REFUTED or "
      "UNDECIDED;\n"
      "2 bad input, or an output that cannot be written; 3 this machine's arithmetic cannot be trusted.");

  bool quiet = false;
  app.add_flag("--quiet", quiet, "no progress on standard error");
  app.fallthrough();

  Arguments arguments;
  add_commands(app, arguments);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string unknown = unknown_command(app, argc, argv); !unknown.empty()) {
      fmt::print(stderr, "{}\n", unknown);
      return bad_input;
    }
    const bool has_extras = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    if (const std::string unknown = unknown_option(app, argc, argv); has_extras && !unknown.empty()) {
      fmt::print(stderr, "{}\n", unknown);
      return bad_input;
    }
    return app.exit(error) == 0 ? all_proved : bad_input;
  }

  arguments.certify.quiet = arguments.check.quiet = arguments.map.quiet = arguments.track.quiet = quiet;
  arguments.diff.quiet = arguments.tie.quiet = arguments.tune.quiet = quiet;

  if (app.got_subcommand("explain")) {
    return run_explain(arguments.explain);
  }
  if (app.got_subcommand("new")) {
    return run_new(arguments.new_design);
  }
  if (app.got_subcommand("completions")) {
    fmt::print("{}", completions(app, arguments.shell));
    return all_proved;
  }
  if (app.got_subcommand("manual")) {
    fmt::print("{}", manual_page(app));
    return all_proved;
  }

  if (!trusts_arithmetic()) {
    return bad_arithmetic;
  }
  if (app.got_subcommand("diff")) {
    return run_diff(arguments.diff);
  }
  if (app.got_subcommand("map")) {
    return run_map(arguments.map);
  }
  if (app.got_subcommand("show")) {
    return run_show(arguments.show);
  }
  if (app.got_subcommand("tie")) {
    return run_tie(arguments.tie);
  }
  if (app.got_subcommand("tune")) {
    return run_tune(arguments.tune);
  }
  if (app.got_subcommand("track")) {
    return run_track(arguments.track);
  }
  return app.got_subcommand("certify") ? run_certify(arguments.certify) : run_check(arguments.check);
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(argc, argv, run);
}
