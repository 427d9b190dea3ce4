// The user's files built as the user builds them, together with a driver, and the program run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "certificates/code/compilation.hpp"
#include "certificates/model/tie/driver_text.hpp"
#include "certificates/model/tie/evaluation.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::certificates::tie {

/// A build command that does not build, a state that its program cannot reach, or a program that fails.
class BuildError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What is built.
struct Sources {
  const trackers::code::Listing* listing = nullptr;
  std::vector<std::filesystem::path> files;        ///< absolute
  std::vector<std::string> flags;                  ///< of the design
  std::map<std::string, std::string> expressions;  ///< of states whose name is none, given by the user
};

/// The files and flags of [code], for a compiler that runs in any folder.
[[nodiscard]] Sources sources_of(const code::CodeTable& code, const trackers::code::Listing& listing,
                                 const std::filesystem::path& design_file);

/// Words of a command, split at spaces.
[[nodiscard]] std::vector<std::string> words_of(const std::string& command);

/// An empty folder that goes away with its contents.
class WorkFolder {
 public:
  /// Throws std::system_error.
  WorkFolder();
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  WorkFolder(WorkFolder&&) = delete;
  WorkFolder& operator=(WorkFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A program that has been built, in a folder of its own. The only thing here that runs code of the user's.
class BuiltProgram {
 public:
  /// Compiles and links; `build` are words such as gcc -O2, in which {} stands for the files (otherwise they
  /// come last); `emulator` is empty where the program runs by itself, or words that its path is put behind.
  /// Throws BuildError.
  BuiltProgram(Sources sources, const std::string& build, const std::string& emulator);

  /// The answers to requests of the same kind, `answer` words each. Throws BuildError.
  [[nodiscard]] std::vector<std::vector<std::uint64_t>> ask(
      Question question, const std::vector<std::vector<std::uint64_t>>& requests, std::size_t answer) const;
  /// The results of a function of its library.
  [[nodiscard]] std::vector<std::uint64_t> library(LibraryFunction function,
                                                   const std::vector<LibraryArguments>& arguments) const;

 private:
  Sources sources_;
  std::string build_;
  std::vector<std::string> emulator_;
  WorkFolder folder_;
};

}  // namespace veritrack::certificates::tie
