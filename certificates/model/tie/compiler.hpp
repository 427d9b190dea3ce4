// The compiler of a build command, run on sources of ours that include files of the user's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "certificates/model/tie/build.hpp"

namespace veritrack::certificates::tie {

class Compiler {
 public:
  Compiler(const Sources& sources, const std::string& build, const std::filesystem::path& folder);

  /// Whether the compiler accepts this text behind a file of the user's. `errors` are its messages.
  [[nodiscard]] bool accepts(std::size_t file, const std::string& text, std::string& errors) const;
  /// The files that states are in, and expressions that reach them. Throws BuildError.
  [[nodiscard]] std::vector<StateAccess> access() const;
  /// The file that declares setup, step and frequency. Throws BuildError.
  [[nodiscard]] std::size_t harness() const;
  /// Builds `program` of one text behind each file, and of `main`. Throws BuildError.
  void build(const std::vector<std::string>& texts, const std::string& main,
             const std::filesystem::path& program) const;

 private:
  [[nodiscard]] std::string refusal(const std::string& errors) const;
  [[nodiscard]] bool reaches(std::size_t file, std::size_t state, const std::string& expression) const;
  /// The build command with these files; `ours` come before the files.
  [[nodiscard]] bool run(const std::vector<std::string>& ours, const std::vector<std::string>& files,
                         std::string& errors) const;

  const Sources* sources_;
  std::string command_;
  std::vector<std::string> words_;
  std::filesystem::path folder_;
  bool has_cpp_ = false;
};

}  // namespace veritrack::certificates::tie
