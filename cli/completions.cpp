// Completions for bash, zsh and fish.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <stdexcept>

#include "cli/command_words.hpp"
#include "cli/shell_words.hpp"

namespace veritrack::cli {

namespace {

constexpr std::array<const char*, 3> kShells{"bash", "zsh", "fish"};

/// The names of the options, without positional arguments.
std::vector<std::string> option_names(const CommandWords& command) {
  std::vector<std::string> names;
  for (const OptionWords& option : command.options) {
    if (!option.is_positional) {
      names.push_back(option.name);
    }
  }
  return names;
}

std::vector<std::string> command_names(const std::vector<CommandWords>& commands) {
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const CommandWords& command : commands) {
    names.push_back(command.name);
  }
  return names;
}

/// The text with a backslash before each of these characters, as a string in single quotes.
std::string quoted(std::string_view text, std::string_view escaped) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
      continue;
    }
    result += escaped.find(c) == std::string_view::npos ? "" : "\\";
    result += c;
  }
  return "'" + result + "'";
}

// ---- bash

std::string bash_case(const CommandWords& command) {
  std::string values;
  std::string positional;
  for (const OptionWords& option : command.options) {
    if (option.is_positional) {
      positional += fmt::format("{} ", fmt::join(option.choices, " "));
    } else if (option.takes_value) {
      values +=
          fmt::format("        {}) words='{}'; value=1 ;;\n", option.name, fmt::join(option.choices, " "));
    }
  }
  return fmt::format(
      "    {})\n      case \"$previous\" in\n{}        *) words='{}'; options='{}' ;;\n      esac ;;\n",
      command.name, values, positional.substr(0, positional.find_last_not_of(' ') + 1),
      fmt::join(option_names(command), " "));
}

std::string bash(const CommandWords& program, const std::vector<CommandWords>& commands) {
  std::string cases;
  for (const CommandWords& command : commands) {
    cases += bash_case(command);
  }
  return fmt::format(R"(# bash completion for veritrack
_veritrack() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  local command='' words='' options='' value='' i
  for ((i = 1; i < COMP_CWORD; i++)); do
    if [[ ${{COMP_WORDS[i]}} != -* ]]; then
      command=${{COMP_WORDS[i]}}
      break
    fi
  done
  case "$command" in
    '') words='{0}'; options='{1}' ;;
{2}  esac
  if [[ -z $value && $word == -* ]]; then
    words="$options {1}"
  fi
  # Nothing found: bash completes names of files.
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}}
complete -o bashdefault -o default -F _veritrack veritrack
)",
                     fmt::join(command_names(commands), " "), fmt::join(option_names(program), " "), cases);
}

// ---- zsh

std::string zsh_action(const OptionWords& option) {
  return option.choices.empty() ? "_files" : fmt::format("({})", fmt::join(option.choices, " "));
}

std::string zsh(const std::vector<CommandWords>& commands) {
  constexpr std::string_view kSpecial = "[]:\\";
  std::string names;
  std::string cases;
  for (const CommandWords& command : commands) {
    names += fmt::format("    {}\n", quoted(command.name + ":" + command.description, ""));
    cases += fmt::format("    {})\n      _arguments", command.name);
    for (const OptionWords& option : command.options) {
      if (option.is_positional) {
        cases += fmt::format(" \\\n        '*:{}:{}'", option.name, zsh_action(option));
        continue;
      }
      std::string description = quoted(option.description, kSpecial);
      description = description.substr(1, description.size() - 2);
      cases += fmt::format(" \\\n        '{}[{}]{}'", option.name, description,
                           option.takes_value ? ":value:" + zsh_action(option) : "");
    }
    cases += " ;;\n";
  }
  return fmt::format(R"(#compdef veritrack
_veritrack() {{
  local -a commands=(
{}  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  ((CURRENT--))
  case $command in
{}  esac
}}
_veritrack "$@"
)",
                     names, cases);
}

// ---- fish

std::string fish(const CommandWords& program, const std::vector<CommandWords>& commands) {
  std::string text = "# fish completion for veritrack\n";
  const auto add = [&](const std::string& condition, const OptionWords& option) {
    std::string line = fmt::format("complete -c veritrack{}", condition);
    if (!option.is_positional) {
      line += fmt::format(" -l {} -d {}", option.name.substr(2), quoted(option.description, "\\"));
    }
    if (!option.choices.empty()) {
      line += fmt::format(" -xa '{}'", fmt::join(option.choices, " "));
    } else if (option.takes_value) {
      line += " -r";
    }
    text += option.is_positional && option.choices.empty() ? "" : line + "\n";
  };
  for (const OptionWords& option : program.options) {
    add("", option);
  }
  for (const CommandWords& command : commands) {
    text += fmt::format("complete -c veritrack -n __fish_use_subcommand -xa {} -d {}\n", command.name,
                        quoted(command.description, "\\"));
  }
  for (const CommandWords& command : commands) {
    for (const OptionWords& option : command.options) {
      add(fmt::format(" -n '__fish_seen_subcommand_from {}'", command.name), option);
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> shell_names() {
  return {kShells.begin(), kShells.end()};
}

std::string completions(const CLI::App& app, std::string_view shell) {
  const CommandWords program = words_of_program(app);
  const std::vector<CommandWords> commands = words_of_commands(app);
  if (shell == kShells[0]) {
    return bash(program, commands);
  }
  if (shell == kShells[1]) {
    return zsh(commands);
  }
  if (shell == kShells[2]) {
    return fish(program, commands);
  }
  throw std::out_of_range("no completions for " + std::string(shell));
}

}  // namespace veritrack::cli
