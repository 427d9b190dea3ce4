#include "cli/hand_over.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "cli/program.hpp"
#include "cli/standard_output.hpp"

namespace veritrack::cli {

namespace {

/// The code that the interpreter runs: the package's own command line, or a message that says how to get it.
constexpr const char* kHandOver =
    "import sys\n"
    "try:\n"
    "    from veritrack.sweep.__main__ import main\n"
    "except ModuleNotFoundError as error:\n"
    "    print(f'veritrack sweep: {sys.executable} has no module {error.name}; install the package for "
    "Python '\n"
    "          '(docs/python.md), or name an interpreter that has it in VERITRACK_PYTHON', file=sys.stderr)\n"
    "    sys.exit(2)\n"
    "sys.exit(main())\n";

/// Does not return unless the program cannot be run; why.
std::string replace_by(const std::string& program, std::vector<std::string> words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  flush_standard_output();
  ::execvp(program.c_str(), arguments.data());
  return std::generic_category().message(errno);
}

}  // namespace

std::optional<std::vector<std::string>> words_after(const std::string& command, int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const auto first =
      std::find_if(words.begin(), words.end(), [](const std::string& word) { return word != "--quiet"; });
  if (first == words.end() || *first != command) {
    return std::nullopt;
  }
  words.erase(first);
  return words;
}

ExitStatus run_reproduce(const std::vector<std::string>& words) {
  std::vector<std::string> arguments{"veritrack reproduce"};
  arguments.insert(arguments.end(), words.begin(), words.end());
  const std::string why = replace_by(path_beside("veritrack-reproduce"), arguments);
  fmt::print(stderr,
             "veritrack reproduce: veritrack-reproduce, beside veritrack, cannot be run: {}; "
             "`make programs` builds it\n",
             why);
  return bad_input;
}

ExitStatus run_sweep(const std::vector<std::string>& words) {
  const char* chosen = std::getenv("VERITRACK_PYTHON");
  std::vector<std::string> arguments{chosen != nullptr && *chosen != '\0' ? chosen : "python3", "-P", "-c",
                                     kHandOver};
  arguments.insert(arguments.end(), words.begin(), words.end());
  const std::string why = replace_by(arguments.front(), arguments);
  fmt::print(stderr,
             "veritrack sweep: {} cannot be run: {}; allowed: Python 3.11 or later as python3, or named in "
             "VERITRACK_PYTHON\n",
             arguments.front(), why);
  return bad_input;
}

}  // namespace veritrack::cli
