#include "certificates/code/compiler.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "certificates/design/input_error.hpp"

namespace veritrack::certificates::code {

namespace {

constexpr unsigned kMostSeconds = 30;  // of processor time, of each program

/// Flags that say what is compiled; others would change what the listing is of.
constexpr std::array<std::string_view, 7> kAllowedFlags{
    "-D", "-U", "-I", "-std=", "-fsingle-precision-constant", "-funsigned-char", "-fsigned-char"};

}  // namespace

bool is_cpp(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".cpp" || ending == ".cc" || ending == ".cxx" || ending == ".hpp";
}

void require_flags(const std::vector<SourceText>& flags, const std::filesystem::path& design_file) {
  for (const SourceText& flag : flags) {
    const bool is_known =
        std::any_of(kAllowedFlags.begin(), kAllowedFlags.end(), [&](std::string_view allowed) {
          return std::string_view(flag.text).substr(0, allowed.size()) == allowed;
        });
    if (!is_known) {
      throw InputError(
          design_file.string(), flag.position,
          fmt::format(
              "the flag {}; allowed: {}; the listing is of the function without optimisations that change "
              "results",
              printable(flag.text, 60), fmt::join(kAllowedFlags, ", ")));
    }
  }
}

std::vector<std::string> flag_arguments(const std::vector<SourceText>& flags,
                                        const std::filesystem::path& folder) {
  std::vector<std::string> arguments;
  for (const SourceText& flag : flags) {
    if (flag.text == "-fsingle-precision-constant") {
      arguments.insert(arguments.end(), {"-Xclang", "-cl-single-precision-constant"});  // clang's name for it
    } else if (flag.text.substr(0, 2) == "-I" && flag.text.size() > 2 && flag.text[2] != '/') {
      arguments.push_back("-I" + (folder / flag.text.substr(2)).string());
    } else {
      arguments.push_back(flag.text);
    }
  }
  return arguments;
}

ProgramRun run_limited(const std::string& program, const std::vector<std::string>& arguments,
                       const std::filesystem::path& design_file, Position position,
                       const std::vector<const MemoryFile*>& handed_over) {
  const std::string name = std::filesystem::path(program).filename().string();
  try {
    ProgramRun result = run_program(program, arguments, "", handed_over, kMostSeconds);
    if (result.signal != 0) {
      throw InputError(design_file.string(), position,
                       fmt::format("{} was ended by signal {}{}", name, result.signal,
                                   result.signal == SIGXCPU ? ", as it took more than 30 s" : ""));
    }
    return result;
  } catch (const std::system_error& error) {
    throw InputError(
        design_file.string(), position,
        fmt::format(
            "{} cannot be run: {}; allowed: [code] where it is installed (clang-14 is a package of Debian; "
            "veritrack-lift is built by `make programs`)",
            name, error.what()));
  }
}

void refuse_compilation(const std::string& errors, const std::filesystem::path& file) {
  const std::size_t found = errors.find("error: ");
  const std::size_t end = std::min(errors.size(), errors.find('\n', found));
  if (found == std::string::npos) {
    throw InputError(file.string(), {}, "clang does not compile it: " + errors.substr(0, 300));
  }
  const std::size_t begin = errors.rfind('\n', found) + 1;  // npos + 1 is 0
  const std::string place = errors.substr(begin, found - begin);
  const std::size_t column = place.rfind(':', place.size() < 3 ? 0 : place.size() - 3);
  const std::size_t line = column == std::string::npos ? column : place.rfind(':', column - 1);
  if (line != std::string::npos) {
    throw InputError(place.substr(0, line),
                     {std::atoi(place.c_str() + line + 1), std::atoi(place.c_str() + column + 1)},
                     errors.substr(found, end - found));
  }
  throw InputError(file.string(), {}, errors.substr(found, end - found));
}

}  // namespace veritrack::certificates::code
