#include "certificates/code/compilation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <iterator>
#include <list>
#include <sstream>
#include <string_view>
#include <system_error>

#include "analysis/rigor/rounding.hpp"
#include "certificates/code/compiler.hpp"
#include "certificates/code/listing_text.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/document/program.hpp"
#include "certificates/document/sha256.hpp"

namespace veritrack::certificates::code {

namespace {

namespace fs = std::filesystem;

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
  const std::vector<std::string> given = flag_arguments(code.flags, folder);
  arguments.insert(arguments.end(), given.begin(), given.end());
  arguments.push_back(path.string());
  return arguments;
}

constexpr std::string_view kInNames = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._/+-";

/// Adds the files that this one includes, but for those of the system, which are not the user's.
void add_included(const CodeTable& code, const SourceText& file, const fs::path& folder,
                  const fs::path& design_file, std::vector<CodeFile>& files) {
  const fs::path path = (folder / file.text).lexically_normal();
  std::vector<std::string> arguments = arguments_for(code, path, folder);
  arguments.insert(arguments.end(), {"-MM", "-MT", "all"});
  const ProgramRun listed = run_limited(kCompiler, arguments, design_file, file.position);
  if (!listed.has_succeeded()) {
    refuse_compilation(listed.errors, path);
  }
  std::istringstream words(listed.output);
  for (std::string word; words >> word;) {
    if (word == "all:" || word == "\\") {
      continue;
    }
    const std::string name =
        fs::path(word).lexically_normal().lexically_relative(folder.lexically_normal()).string();
    if (std::any_of(files.begin(), files.end(), [&](const CodeFile& each) { return each.name == name; }) ||
        std::any_of(code.files.begin(), code.files.end(),
                    [&](const SourceText& each) { return fs::path(each.text).lexically_normal() == name; })) {
      continue;
    }
    if (name.empty() || name.find_first_not_of(kInNames) != std::string::npos) {
      refuse(design_file, file.position,
             fmt::format("{} includes {}; allowed: files with names of letters, digits and ._/+-", file.text,
                         printable(word, 60)));
    }
    files.push_back({name, sha256(read_file(folder / name, design_file, file.position)), true});
  }
}

/// Names stand in sentences, each once.
void require_names(const CodeTable& code, const fs::path& design_file) {
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
  require_flags(code.flags, design_file);
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
        run_limited(kCompiler, arguments_for(code, path, folder), design_file, file.position);
    if (!compilation.has_succeeded()) {
      refuse_compilation(compilation.errors, path);
    }
    const MemoryFile& module = modules.emplace_back(compilation.output);
    handed_over.push_back(&module);
    paths.push_back(module.path());
  }
  for (const SourceText& file : code.files) {
    add_included(code, file, folder, design_file, result.files);
  }
  const std::string version = run_limited(kCompiler, {"--version"}, design_file, code.position).output;
  result.compiler = version.substr(0, version.find('\n'));
  const ProgramRun lifting =
      run_limited(beside("veritrack-lift"), paths, design_file, code.files.front().position, handed_over);
  if (!lifting.has_succeeded()) {
    refuse_lifting(lifting.errors, folder, code, design_file);
  }
  result.listing_text = lifting.output;
  try {
    result.listing = parse_listing(result.listing_text);
  } catch (const ListingError& error) {
    refuse(design_file, code.position, fmt::format("veritrack-lift made no listing: {}", error.what()));
  }
  const rigor::UpwardRounding upward;
  result.arc_tangent = model::code::arc_tangent(result.listing);
  result.replaced =
      result.arc_tangent ? with_arc_tangent(result.listing, *result.arc_tangent) : result.listing;
  return result;
}

}  // namespace veritrack::certificates::code
