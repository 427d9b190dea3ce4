// The manual page, from the commands and their help.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/command_words.hpp"
#include "cli/shell_words.hpp"

namespace veritrack::cli {

namespace {

/// The text for troff: no hyphens instead of minus signs, and no line that begins with a command.
std::string roff(std::string_view text) {
  std::string result;
  bool is_line_start = true;
  for (const char c : text) {
    if (is_line_start && (c == '.' || c == '\'')) {
      result += "\\&";
    }
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
    is_line_start = c == '\n';
  }
  return result;
}

std::string described(const OptionWords& option) {
  std::string text = option.description;
  if (!option.choices.empty()) {
    text += fmt::format(": {}", fmt::join(option.choices, ", "));
  }
  return fmt::format(".TP\n.B {}{}\n{}\n", roff(option.name),
                     option.takes_value && !option.is_positional ? " \\fIVALUE\\fR" : "", roff(text));
}

std::string section_of(const CommandWords& command) {
  std::string usage = ".B veritrack " + roff(command.name) + "\n[\\fIOPTIONS\\fR]";
  for (const OptionWords& option : command.options) {
    usage += option.is_positional ? fmt::format(" \\fI{}\\fR", roff(option.name)) : "";
  }
  std::string text =
      fmt::format(".SS {}\n{}\n.PP\n{}\n", roff(command.name), usage, roff(command.description + "."));
  for (const OptionWords& option : command.options) {
    text += option.name == "--help" ? "" : described(option);
  }
  if (!command.examples.empty()) {
    text += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command.examples));
  }
  return text;
}

}  // namespace

std::string manual_page(const CLI::App& app) {
  const CommandWords program = words_of_program(app);
  std::string text = fmt::format(
      ".TH VERITRACK 1 \"\" \"veritrack {}\"\n.SH NAME\nveritrack \\- certificates for frequency trackers\n"
      ".SH SYNOPSIS\n.B veritrack\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n{}\n"
      "Each claim about a design is PROVED, REFUTED or UNDECIDED, with outward\\-rounded interval "
      "arithmetic.\n.SH OPTIONS\n",
      VERITRACK_VERSION, roff(app.get_description()));
  for (const OptionWords& option : program.options) {
    text += described(option);
  }
  text += ".SH COMMANDS\n";
  for (const CommandWords& command : words_of_commands(app)) {
    text += section_of(command);
  }
  return text + ".SH EXIT STATUS\n" + roff(app.get_footer()) + "\n.SH SEE ALSO\n.BR veritrack\\-verify (1)\n";
}

}  // namespace veritrack::cli
