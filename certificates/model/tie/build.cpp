#include "certificates/model/tie/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <utility>

#include "certificates/design/input_error.hpp"
#include "certificates/document/program.hpp"
#include "certificates/model/tie/compiler.hpp"

namespace veritrack::certificates::tie {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::uint64_t>;

constexpr unsigned kMostSecondsToRun = 300;  // of processor time
constexpr std::size_t kWordBytes = 8;
constexpr std::size_t kShownText = 120;  // bytes

void append(std::string& bytes, std::uint64_t word) {
  for (std::size_t i = 0; i < kWordBytes; ++i) {
    bytes += static_cast<char>(word >> (8 * i) & 255U);
  }
}

std::uint64_t word_at(const std::string& bytes, std::size_t number) {
  std::uint64_t word = 0;
  for (std::size_t i = kWordBytes; i-- > 0;) {
    word = word << 8U | static_cast<unsigned char>(bytes[number * kWordBytes + i]);
  }
  return word;
}

/// The first bytes of an ELF file, which name its processor.
std::string processor_of(const fs::path& program) {
  constexpr std::size_t kHeader =
      20;  // bytes: with e_machine, and before it the class and the order of bytes
  std::string header(kHeader, '\0');
  std::ifstream(program, std::ios::binary).read(header.data(), kHeader);
  return header.substr(4, 2) + header.substr(kHeader - 2);
}

}  // namespace

Sources sources_of(const code::CodeTable& code, const trackers::code::Listing& listing,
                   const fs::path& design_file) {
  const fs::path folder = fs::absolute(design_file).parent_path();
  Sources sources;
  sources.listing = &listing;
  for (const SourceText& file : code.files) {
    sources.files.push_back((folder / file.text).lexically_normal());
  }
  for (const SourceText& flag : code.flags) {
    const bool is_folder = flag.text.substr(0, 2) == "-I" && flag.text.size() > 2;
    // An absolute path stays what it is.
    sources.flags.push_back(is_folder ? "-I" + (folder / flag.text.substr(2)).string() : flag.text);
  }
  return sources;
}

std::vector<std::string> words_of(const std::string& command) {
  std::istringstream stream(command);
  return {std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()};
}

WorkFolder::WorkFolder() {
  std::string name = (fs::absolute(fs::temp_directory_path()) / "veritrack-tie-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw std::system_error(errno, std::generic_category(), "a folder for the program that is built");
  }
  path_ = name;
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

BuiltProgram::BuiltProgram(Sources sources, const std::string& build, const std::string& emulator)
    : sources_(std::move(sources)), build_(build), emulator_(words_of(emulator)) {
  const Compiler compiler(sources_, build, folder_.path());
  const std::vector<StateAccess> access = compiler.access();
  const std::size_t harness = compiler.harness();
  std::vector<std::string> texts(sources_.files.size());
  for (std::size_t state = 0; state < access.size(); ++state) {
    const auto input = static_cast<std::size_t>(sources_.listing->states[state].input);
    texts.at(access[state].file) +=
        access_text(state, sources_.listing->instructions[input].format, access[state].expression);
  }
  texts.at(harness) += harness_text(*sources_.listing);
  const fs::path program = folder_.path() / "program";
  compiler.build(texts, main_text(*sources_.listing, folder_.path() / "in", folder_.path() / "out"), program);
  if (emulator_.empty() && processor_of(program) != processor_of("/proc/self/exe")) {
    throw BuildError(fmt::format(
        "the program of --build \"{}\" is for another processor; allowed: --emulator with what runs it",
        printable(build_, kShownText)));
  }
}

std::vector<Words> BuiltProgram::ask(Question question, const std::vector<Words>& requests,
                                     std::size_t answer) const {
  std::string in;
  append(in, static_cast<std::uint64_t>(question));
  append(in, requests.size());
  for (const Words& request : requests) {
    for (const std::uint64_t word : request) {
      append(in, word);
    }
  }
  std::ofstream(folder_.path() / "in", std::ios::binary) << in;
  fs::remove(folder_.path() / "out");
  std::vector<std::string> words = emulator_;
  words.push_back((folder_.path() / "program").string());
  const auto fail = [&](const std::string& why) {
    return BuildError(fmt::format("the program of --build \"{}\" {}", printable(build_, kShownText), why));
  };
  try {
    const ProgramRun run = run_program(words.front(), {words.begin() + 1, words.end()}, "",
                                       std::vector<const MemoryFile*>{}, kMostSecondsToRun);
    if (run.signal != 0) {
      throw fail(fmt::format(
          "was ended by signal {}{}", run.signal,
          run.signal == SIGXCPU ? fmt::format(", as it took more than {} s", kMostSecondsToRun) : ""));
    }
  } catch (const std::system_error& error) {
    throw fail(fmt::format("cannot be run by {}: {}",
                           emulator_.empty() ? "this machine" : printable(emulator_.front(), kShownText),
                           error.code().message()));
  }
  std::ifstream file(folder_.path() / "out", std::ios::binary);
  const std::string out{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::size_t answers = std::max<std::size_t>(requests.size(), question == Question::start ? 1 : 0);
  if (out.size() != answers * answer * kWordBytes) {
    throw fail(
        fmt::format("has answered {} of {} requests and ended", out.size() / (answer * kWordBytes), answers));
  }
  std::vector<Words> result(answers, Words(answer));
  for (std::size_t i = 0; i < answers; ++i) {
    for (std::size_t k = 0; k < answer; ++k) {
      result[i][k] = word_at(out, i * answer + k);
    }
  }
  return result;
}

std::vector<std::uint64_t> BuiltProgram::library(LibraryFunction function,
                                                 const std::vector<LibraryArguments>& arguments) const {
  const std::vector<LibraryFunction> known = library_functions(*sources_.listing);
  const auto number = static_cast<std::uint64_t>(
      std::distance(known.begin(), std::find(known.begin(), known.end(), function)));
  std::vector<Words> requests;
  requests.reserve(arguments.size());
  for (const LibraryArguments& call : arguments) {
    requests.push_back({number, call[0], call[1]});
  }
  Words results;
  for (const Words& answer : ask(Question::library, requests, 1)) {
    results.push_back(answer.front());
  }
  return results;
}

}  // namespace veritrack::certificates::tie
