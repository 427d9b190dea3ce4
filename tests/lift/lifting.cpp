#include "tests/lift/lifting.hpp"

#include <fmt/format.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IRReader/IRReader.h>
#include <llvm/Support/SourceMgr.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <regex>
#include <stdexcept>

#include "lift/lifted.hpp"
#include "tests/support/scratch_folder.hpp"

namespace veritrack::lift {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFlags =
    "-O1 -g -ffp-contract=off -fno-builtin -fno-math-errno -fno-vectorize -fno-slp-vectorize "
    "-fno-exceptions -fno-discard-value-names -w -emit-llvm -c";

bool is_cpp(const fs::path& path) {
  return path.extension() == ".cpp";
}

void execute(const std::string& command) {
  if (std::system(command.c_str()) != 0) {  // NOLINT(cert-env33-c): a test, of commands of its own
    throw std::runtime_error("failed: " + command);
  }
}

std::string expression_of(const std::string& name, const std::map<std::string, std::string>& expressions) {
  const auto known = expressions.find(name);
  static const std::regex kIndex("_([0-9]+)(?=[.]|$)");
  return known != expressions.end() ? known->second : std::regex_replace(name, kIndex, "[$1]");
}

/// The file and a main that reads bits of states and samples, and writes those after a step.
std::string program_text(const fs::path& source, const trackers::code::Listing& listing,
                         const std::map<std::string, std::string>& expressions) {
  std::string set;
  std::string get;
  for (std::size_t i = 0; i < listing.states.size(); ++i) {
    const std::string expression = expression_of(listing.states[i].name, expressions);
    set += fmt::format("    memcpy((void*)&({0}), &in_[{1}], sizeof({0}));\n", expression, i);
    get += fmt::format("    memcpy(&out_[{1}], (const void*)&({0}), sizeof({0}));\n", expression, i);
  }
  std::string samples;
  std::string zeros;
  std::string declared;
  for (std::size_t i = 0; i < listing.samples.size(); ++i) {
    const auto format = listing.instructions[static_cast<std::size_t>(listing.samples[i])].format;
    const std::string type = format.bits == 32 ? "float" : "double";
    declared += fmt::format("    {0} y{1};\n    memcpy(&y{1}, &in_[{2}], sizeof y{1});\n", type, i,
                            listing.states.size() + i);
    samples += fmt::format("{}y{}", i == 0 ? "" : ", ", i);
    zeros += i == 0 ? "0.3f" : ", 0.1f";
  }
  const std::size_t in = listing.states.size() + listing.samples.size();
  const std::size_t out = listing.states.size() + 1;
  return fmt::format(R"(#include "{0}"
#include <stdio.h>
#include <string.h>
int main() {{
  unsigned long long in_[{1}], out_[{2}];
  setup();
  memset(out_, 0, sizeof out_);
{8}  const {10} start_ = frequency();
  memcpy(&out_[{2} - 1], &start_, sizeof start_);
  if (fwrite(out_, sizeof out_, 1, stdout) != 1) return 1;
  for (int i = 0; i < {3}; ++i) step({4});
  while (fread(in_, sizeof in_, 1, stdin) == 1) {{
{5}{6}    memset(out_, 0, sizeof out_);
    const {10} frequency_ = frequency();
    memcpy(&out_[{2} - 1], &frequency_, sizeof frequency_);
    step({7});
{8}    if (fwrite(out_, sizeof out_, 1, stdout) != 1) return 1;
  }}
  return {9};
}}
)",
                     source.string(), in, out, listing.steps_before, zeros, set, declared, samples, get, 0,
                     is_cpp(source) ? "auto" : "__auto_type");
}

}  // namespace

LiftResult lift_file(const fs::path& source, const std::string& flags) {
  const test::ScratchFolder folder;
  const std::string compiled = (folder / "step.bc").string();
  const std::string compiler = is_cpp(source) ? "clang++-14 -fno-access-control -std=c++17" : "clang-14";
  execute(fmt::format("{} {} {} -o {} {}", compiler, kFlags, flags, compiled, source.string()));
  llvm::LLVMContext context;
  llvm::SMDiagnostic diagnostic;
  const std::unique_ptr<llvm::Module> module = llvm::parseIRFile(compiled, diagnostic, context);
  if (!module) {
    throw std::runtime_error(diagnostic.getMessage().str());
  }
  Executor executor(*module);
  LiftResult result;
  try {
    result.listing = lifted(executor);
  } catch (const LiftError& error) {
    const Place place = executor.graph().place();
    const std::string file =
        place.file < 0 ? "" : fs::path(executor.files()[static_cast<std::size_t>(place.file)]).filename();
    result.error = place.file < 0 ? error.what()
                                  : fmt::format("{}:{}:{}: {}", file, place.line, place.column, error.what());
  }
  return result;
}

LiftResult lift_text(const std::string& text, const std::string& name, const std::string& flags) {
  const test::ScratchFolder folder;
  std::ofstream(folder / name) << text;
  return lift_file(folder / name, flags);
}

void run_compiled(const fs::path& source, const std::string& compiler, const trackers::code::Listing& listing,
                  const std::map<std::string, std::string>& expressions, Runs& steps) {
  const test::ScratchFolder folder;
  const fs::path main = folder / (is_cpp(source) ? "main.cpp" : "main.c");
  std::ofstream(main) << program_text(source, listing, expressions);
  const std::string program = (folder / "program").string();
  execute(fmt::format("{} -w -ffp-contract=off {} {} -o {} -lm", compiler,
                      is_cpp(source) ? "-std=c++17 -fno-access-control" : "", main.string(), program));
  {
    std::ofstream in(folder / "in", std::ios::binary);
    for (const auto& bits : steps.before) {
      in.write(reinterpret_cast<const char*>(bits.data()),  // NOLINT: bytes of a file
               static_cast<std::streamsize>(bits.size() * sizeof bits[0]));
    }
  }
  execute(fmt::format("{} < {} > {}", program, (folder / "in").string(), (folder / "out").string()));
  std::ifstream out(folder / "out", std::ios::binary);
  const std::size_t count = listing.states.size() + 1;
  steps.start.assign(count, 0);
  steps.after.assign(steps.before.size(), std::vector<std::uint64_t>(count));
  const auto read = [&](std::vector<std::uint64_t>& bits) {
    out.read(reinterpret_cast<char*>(bits.data()),  // NOLINT: bytes of a file
             static_cast<std::streamsize>(bits.size() * sizeof bits[0]));
    if (!out) {
      throw std::runtime_error("the program has not done all steps");
    }
  };
  read(steps.start);
  for (auto& bits : steps.after) {
    read(bits);
  }
}

}  // namespace veritrack::lift
