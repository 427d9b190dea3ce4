#include "certificates/model/tie/compiler.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "certificates/design/input_error.hpp"
#include "certificates/document/program.hpp"

namespace veritrack::certificates::tie {

namespace {

namespace fs = std::filesystem;
using trackers::code::Listing;

constexpr unsigned kMostSecondsToCompile = 300;  // of processor time
constexpr std::size_t kShownCommand = 120;       // bytes

bool is_of_cpp(const fs::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".cpp" || ending == ".cc" || ending == ".cxx" || ending == ".hpp";
}

trackers::code::Format format_of_state(const Listing& listing, std::size_t state) {
  return listing.instructions[static_cast<std::size_t>(listing.states[state].input)].format;
}

}  // namespace

Compiler::Compiler(const Sources& sources, const std::string& build, const fs::path& folder)
    : sources_(&sources),
      command_(printable(build, kShownCommand)),
      words_(words_of(build)),
      folder_(folder),
      has_cpp_(std::any_of(sources.files.begin(), sources.files.end(), is_of_cpp)) {
  if (words_.empty()) {
    throw BuildError("--build is empty; allowed: a compiler and its flags, e.g. --build \"gcc -O2\"");
  }
}

bool Compiler::run(const std::vector<std::string>& ours, const std::vector<std::string>& files,
                   std::string& errors) const {
  std::vector<std::string> added = sources_->flags;
  added.emplace_back("-w");
  if (has_cpp_) {
    added.emplace_back("-fno-access-control");  // states may be private members
  }
  added.insert(added.end(), ours.begin(), ours.end());
  added.insert(added.end(), files.begin(), files.end());
  added.insert(added.end(), {"-x", "none"});
  std::vector<std::string> arguments;
  bool is_placed = false;
  for (auto word = words_.begin() + 1; word != words_.end(); ++word) {
    if (*word == "{}" && !is_placed) {
      arguments.insert(arguments.end(), added.begin(), added.end());
      is_placed = true;
    } else {
      arguments.push_back(*word);
    }
  }
  if (!is_placed) {
    arguments.insert(arguments.end(), added.begin(), added.end());
  }
  arguments.emplace_back("-lm");
  try {
    const ProgramRun compiled =
        run_program(words_.front(), arguments, "", std::vector<const MemoryFile*>{}, kMostSecondsToCompile);
    errors = compiled.errors;
    return compiled.has_succeeded();
  } catch (const std::system_error& error) {
    throw BuildError(fmt::format(
        "--build \"{}\": {} cannot be run: {}; allowed: a compiler and its flags, split at spaces", command_,
        printable(words_.front(), kShownCommand), error.code().message()));
  }
}

bool Compiler::accepts(std::size_t file, const std::string& text, std::string& errors) const {
  const bool is_cpp = is_of_cpp(sources_->files[file]);
  const fs::path source = folder_ / (is_cpp ? "probe.cpp" : "probe.c");
  std::ofstream(source) << include_text(sources_->files[file]) << text;
  return run({"-fsyntax-only"}, {"-x", is_cpp ? "c++" : "c", source.string()}, errors);
}

std::string Compiler::refusal(const std::string& errors) const {
  const std::size_t found = errors.find("error: ");
  const std::size_t begin = found == std::string::npos ? 0 : errors.rfind('\n', found) + 1;  // npos + 1 is 0
  std::string first = errors.substr(begin, errors.find('\n', begin) - begin);
  const std::string folder = folder_.string() + "/";
  for (std::size_t place = first.find(folder); place != std::string::npos; place = first.find(folder)) {
    first.erase(place, folder.size());
  }
  constexpr std::size_t kShownError = 300;
  return fmt::format("--build \"{}\" fails: {}", command_, printable(first, kShownError));
}

bool Compiler::reaches(std::size_t file, std::size_t state, const std::string& expression) const {
  std::string errors;
  return accepts(file, access_text(state, format_of_state(*sources_->listing, state), expression), errors);
}

std::vector<StateAccess> Compiler::access() const {
  const Listing& listing = *sources_->listing;
  for (std::size_t file = 0; file < sources_->files.size(); ++file) {
    std::string errors;
    if (!accepts(file, "", errors)) {
      throw BuildError(refusal(errors));
    }
  }
  std::vector<StateAccess> result;
  for (std::size_t state = 0; state < listing.states.size(); ++state) {
    const std::string& name = listing.states[state].name;
    const auto given = sources_->expressions.find(name);
    const std::vector<std::string> expressions =
        given != sources_->expressions.end() ? std::vector<std::string>{given->second} : expressions_of(name);
    const std::size_t before = result.size();
    for (std::size_t file = 0; file < sources_->files.size() && result.size() == before; ++file) {
      for (auto each = expressions.begin(); each != expressions.end() && result.size() == before; ++each) {
        if (reaches(file, state, *each)) {
          result.push_back({file, *each});
        }
      }
    }
    if (result.size() == before) {
      throw BuildError(fmt::format(
          "the state {} cannot be set from outside of the functions: no file of [code] has a variable {}; "
          "allowed: --state {}=EXPRESSION, in C, of variables that are declared in a file outside of "
          "functions",
          name, fmt::join(expressions, " or "), name));
    }
  }
  return result;
}

std::size_t Compiler::harness() const {
  std::string errors;
  for (std::size_t file = 0; file < sources_->files.size(); ++file) {
    if (accepts(file, harness_text(*sources_->listing), errors)) {
      return file;
    }
  }
  throw BuildError(refusal(errors));
}

void Compiler::build(const std::vector<std::string>& texts, const std::string& main,
                     const fs::path& program) const {
  std::vector<std::string> files;
  const auto add = [&](const std::string& name, bool is_cpp, const std::string& text) {
    const fs::path source = folder_ / (name + (is_cpp ? ".cpp" : ".c"));
    std::ofstream(source) << text;
    files.insert(files.end(), {"-x", is_cpp ? "c++" : "c", source.string()});
  };
  for (std::size_t file = 0; file < texts.size(); ++file) {
    add(fmt::format("file_{}", file), is_of_cpp(sources_->files[file]),
        include_text(sources_->files[file]) + texts[file]);
  }
  add("main", has_cpp_, main);
  std::string errors;
  if (!run({"-o", program.string()}, files, errors)) {
    throw BuildError(refusal(errors));
  }
}

}  // namespace veritrack::certificates::tie
