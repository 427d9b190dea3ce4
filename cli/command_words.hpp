// The commands and options of the program as words, for completions and the manual page.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace veritrack::cli {

/// An option, or a positional argument.
struct OptionWords {
  std::string name;                  ///< "--out", or "DESIGN"
  std::string description;           ///< on one line
  std::vector<std::string> choices;  ///< its values, when these are all
  bool is_positional = false;
  bool takes_value = false;
};

/// A command, or the program itself.
struct CommandWords {
  std::string name;
  std::string description;
  std::string examples;  ///< lines; empty for the program itself
  std::vector<OptionWords> options;
};

/// The options of the program itself, which come before the commands.
[[nodiscard]] CommandWords words_of_program(const CLI::App& app);
/// All commands in the order of the help.
[[nodiscard]] std::vector<CommandWords> words_of_commands(const CLI::App& app);

}  // namespace veritrack::cli
