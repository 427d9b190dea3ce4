// veritrack sweep: many designs, handed over to the package for Python.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "cli/commands.hpp"

namespace veritrack::cli {

namespace {

/// What the interpreter runs: the package's own command line, or a message that says how to get it.
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

}  // namespace

ExitStatus run_sweep(const SweepOptions& options) {
  const char* chosen = std::getenv("VERITRACK_PYTHON");
  std::vector<std::string> words{chosen != nullptr && *chosen != '\0' ? chosen : "python3", "-P", "-c",
                                 kHandOver};
  words.insert(words.end(), options.words.begin(), options.words.end());
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  std::fflush(stdout);
  ::execvp(arguments.front(), arguments.data());
  fmt::print(stderr,
             "veritrack sweep: {} cannot be run: {}; allowed: Python 3.11 or later as python3, or named in "
             "VERITRACK_PYTHON\n",
             words.front(), std::generic_category().message(errno));
  return bad_input;
}

}  // namespace veritrack::cli
