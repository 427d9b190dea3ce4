#include "cli/command_words.hpp"

#include <sstream>

namespace veritrack::cli {

namespace {

/// "a" and "b" of "TEXT:{a,b}": CLI11 tells the choices of an option in the name of its type only.
std::vector<std::string> choices_in(const std::string& type_name) {
  std::vector<std::string> choices;
  const std::size_t open = type_name.find('{');
  const std::size_t close = type_name.find('}');
  if (open == std::string::npos || close == std::string::npos) {
    return choices;
  }
  std::istringstream list(type_name.substr(open + 1, close - open - 1));
  for (std::string choice; std::getline(list, choice, ',');) {
    choices.push_back(choice);
  }
  return choices;
}

CommandWords words_of(const CLI::App& app) {
  constexpr std::string_view kHeading = "Examples:\n";
  CommandWords command{app.get_name(), app.get_description(), "", {}};
  if (const std::string footer = app.get_footer(); footer.starts_with(kHeading)) {
    command.examples = footer.substr(kHeading.size());
  }
  for (const CLI::Option* option : app.get_options()) {
    OptionWords words;
    words.is_positional = option->get_positional();
    words.name = option->get_lnames().empty() ? option->get_name() : "--" + option->get_lnames().front();
    words.description = option->get_description();
    words.choices = choices_in(option->get_type_name());
    words.takes_value = option->get_items_expected_min() > 0;  // a flag expects none
    command.options.push_back(std::move(words));
  }
  return command;
}

}  // namespace

CommandWords words_of_program(const CLI::App& app) {
  return words_of(app);
}

std::vector<CommandWords> words_of_commands(const CLI::App& app) {
  std::vector<CommandWords> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    commands.push_back(words_of(*command));
  }
  return commands;
}

}  // namespace veritrack::cli
