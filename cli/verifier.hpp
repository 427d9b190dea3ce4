// veritrack-verify, the checker that shares no code with this program.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "reports/certificate_files.hpp"

namespace veritrack::cli {

/// There is no checker of this release. what() says in one line how to get it.
struct NoVerifier : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The checker of this release, in the folder in which this program is: in a build as it is installed.
class Verifier {
 public:
  /// Throws NoVerifier.
  Verifier();

  /// Has all parts verified. No file is left behind, whatever happens; the checker ends with this process.
  /// After Ctrl-C it is left out.
  [[nodiscard]] certificates::Verification operator()(const reports::TextsToVerify& texts) const;

  /// The file of the program.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// "veritrack-verify refuses 4 of 100 parts: contraction (radius: ...); ...", or why it gave no answer.
[[nodiscard]] std::string refusal_sentence(const certificates::Verification& verification);

}  // namespace veritrack::cli
