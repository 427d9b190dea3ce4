#include "certificates/code/compilation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <iterator>
#include <list>
#include <string_view>
#include <system_error>

#include "certificates/code/listing_text.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/document/program.hpp"
#include "certificates/document/sha256.hpp"

namespace veritrack::certificates::code {

namespace {

namespace fs = std::filesystem;

constexpr unsigned kMostSeconds = 30;  // of processor time, of each program
constexpr const char* kCompiler = "clang-14";

/// Flags that say what is compiled; others would change what the listing is of.
constexpr std::array<std::string_view, 7> kAllowedFlags{
    "-D", "-U", "-I", "-std=", "-fsingle-precision-constant", "-funsigned-char", "-fsigned-char"};

[[noreturn]] void refuse(const fs::path& file, Position position, const std::string& message) {
  throw InputError(file.string(), position, message);
}

std::string read_file(const fs::path& path, const fs::path& design_file, Position position) {
  std::ifstream file(path, std::ios::binary);
  if (!file || fs::is_directory(path)) {
    refuse(design_file, position,
           fmt::format("{} cannot be read; allowed: a file of C or C++, named from the folder of "
                       "this one",
                       printable(path.string(), 200)));
  }
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool is_cpp(const fs::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".cpp" || ending == ".cc" || ending == ".cxx" || ending == ".hpp";
}

std::vector<std::string> arguments_for(const CodeTable& code, const fs::path& path, const fs::path& folder) {
  std::vector<std::string> arguments{"-O1",
                                     "-g",
                                     "-ffp-contract=off",
                                     "-fno-builtin",
                                     "-fno-math-errno",
                                     "-fno-vectorize",
                                     "-fno-slp-vectorize",
                                     "-fno-exceptions",
                                     "-fno-discard-value-names",
                                     "-emit-llvm",
                                     "-c",
                                     "-o",
                                     "-"};
  if (is_cpp(path)) {
    arguments.emplace_back("-fno-access-control");
    arguments.emplace_back("-std=gnu++17");  // what GCC 11 and later begin with
  }
  // No name of a folder of this machine in what is written.
  arguments.push_back(fmt::format("-fdebug-prefix-map={}/=", folder.string()));
  arguments.emplace_back("-fdebug-compilation-dir=.");
  for (const SourceText& flag : code.flags) {
    if (flag.text == "-fsingle-precision-constant") {
      arguments.insert(arguments.end(), {"-Xclang", "-cl-single-precision-constant"});  // clang's name for it
    } else if (flag.text.substr(0, 2) == "-I" && flag.text.size() > 2 && flag.text[2] != '/') {
      arguments.push_back("-I" + (folder / flag.text.substr(2)).string());
    } else {
      arguments.push_back(flag.text);
    }
  }
  arguments.push_back(path.string());
  return arguments;
}

void require_flags(const CodeTable& code, const fs::path& design_file) {
  for (const SourceText& flag : code.flags) {
    const bool is_known =
        std::any_of(kAllowedFlags.begin(), kAllowedFlags.end(), [&](std::string_view allowed) {
          return std::string_view(flag.text).substr(0, allowed.size()) == allowed;
        });
    if (!is_known) {
      refuse(design_file, flag.position,
             fmt::format(
                 "the flag {}; allowed: {}; the listing is of the function without optimisations that change "
                 "results",
                 printable(flag.text, 60), fmt::join(kAllowedFlags, ", ")));
    }
  }
}

/// Names stand in sentences, each once.
void require_names(const CodeTable& code, const fs::path& design_file) {
  constexpr std::string_view kInNames = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._/+-";
  for (auto file = code.files.begin(); file != code.files.end(); ++file) {
    const bool is_twice = std::any_of(code.files.begin(), file,
                                      [&](const SourceText& each) { return each.text == file->text; });
    if (is_twice || file->text.find_first_not_of(kInNames) != std::string::npos) {
      refuse(design_file, file->position,
             fmt::format("the file {}{}; allowed: files, each once, with names of letters, digits and ._/+-",
                         printable(file->text, 60), is_twice ? " a second time" : ""));
    }
  }
}

ProgramRun run(const std::string& program, const std::vector<std::string>& arguments,
               const fs::path& design_file, Position position,
               const std::vector<const MemoryFile*>& handed_over = {}) {
  try {
    ProgramRun result = run_program(program, arguments, "", handed_over, kMostSeconds);
    if (result.signal != 0) {
      refuse(design_file, position,
             fmt::format("{} was ended by signal {}{}", fs::path(program).filename().string(), result.signal,
                         result.signal == SIGXCPU ? ", as it took more than 30 s" : ""));
    }
    return result;
  } catch (const std::system_error& error) {
    refuse(
        design_file, position,
        fmt::format(
            "{} cannot be run: {}; allowed: [code] where it is installed (clang-14 is a package of Debian; "
            "veritrack-lift is built by `make programs`)",
            fs::path(program).filename().string(), error.what()));
  }
}

/// The first error of a compiler, "file:line:column: error: what", as an error of ours.
[[noreturn]] void refuse_compilation(const std::string& errors, const fs::path& file) {
  const std::size_t found = errors.find("error: ");
  const std::size_t end = std::min(errors.size(), errors.find('\n', found));
  Position position;
  if (found == std::string::npos) {
    refuse(file, position, "clang does not compile it: " + errors.substr(0, 300));
  }
  const std::size_t begin = errors.rfind('\n', found) + 1;  // npos + 1 is 0
  const std::string place = errors.substr(begin, found - begin);
  const std::size_t column = place.rfind(':', place.size() < 3 ? 0 : place.size() - 3);
  const std::size_t line = column == std::string::npos ? column : place.rfind(':', column - 1);
  if (line != std::string::npos) {
    position = {std::atoi(place.c_str() + line + 1), std::atoi(place.c_str() + column + 1)};
    refuse(place.substr(0, line), position, errors.substr(found, end - found));
  }
  refuse(file, position, errors.substr(found, end - found));
}

/// An error of veritrack-lift, "file:line:column: what".
[[noreturn]] void refuse_lifting(const std::string& errors, const fs::path& folder, const CodeTable& code,
                                 const fs::path& design_file) {
  const std::string text = errors.substr(0, errors.find('\n'));
  const std::size_t line = text.find(':');
  const std::size_t column = line == std::string::npos ? line : text.find(':', line + 1);
  const std::size_t what = column == std::string::npos ? column : text.find(": ", column + 1);
  if (what != std::string::npos && std::atoi(text.c_str() + line + 1) > 0) {
    const fs::path file = text.substr(0, line);
    refuse(file.is_absolute() ? file : (folder / file).lexically_normal(),
           {std::atoi(text.c_str() + line + 1), std::atoi(text.c_str() + column + 1)}, text.substr(what + 2));
  }
  refuse(design_file, code.files.front().position, text);
}

/// A program that lies beside this one, or a folder above, where the tests are, or in PATH.
std::string beside(const char* name) {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& place : {here / name, here.parent_path() / name}) {
    if (fs::exists(place, error)) {
      return place.string();
    }
  }
  return name;
}

}  // namespace

CompiledCode compiled(const CodeTable& code, const fs::path& design_file) {
  require_flags(code, design_file);
  require_names(code, design_file);
  const fs::path folder = design_file.has_parent_path() ? design_file.parent_path() : fs::path(".");
  CompiledCode result;
  std::list<MemoryFile> modules;
  std::vector<const MemoryFile*> handed_over;
  std::vector<std::string> paths;
  for (const SourceText& file : code.files) {
    const fs::path path = (folder / file.text).lexically_normal();
    result.files.push_back({file.text, sha256(read_file(path, design_file, file.position))});
    const ProgramRun compilation =
        run(kCompiler, arguments_for(code, path, folder), design_file, file.position);
    if (!compilation.has_succeeded()) {
      refuse_compilation(compilation.errors, path);
    }
    const MemoryFile& module = modules.emplace_back(compilation.output);
    handed_over.push_back(&module);
    paths.push_back(module.path());
  }
  const std::string version = run(kCompiler, {"--version"}, design_file, code.position).output;
  result.compiler = version.substr(0, version.find('\n'));
  const ProgramRun lifting =
      run(beside("veritrack-lift"), paths, design_file, code.files.front().position, handed_over);
  if (!lifting.has_succeeded()) {
    refuse_lifting(lifting.errors, folder, code, design_file);
  }
  result.listing_text = lifting.output;
  try {
    result.listing = parse_listing(result.listing_text);
  } catch (const ListingError& error) {
    refuse(design_file, code.position, fmt::format("veritrack-lift made no listing: {}", error.what()));
  }
  return result;
}

}  // namespace veritrack::certificates::code
