// Verdicts of design files that were checked before, kept in a folder of the user's.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "reports/check/checked_design.hpp"

namespace veritrack::reports {

/// Kept under the SHA-256 of the design's text and of the program: another text or program does not find it.
/// Anyone who can write to the folder can write verdicts; files of other users, or that others can write to,
/// are not read.
class CheckCache {
 public:
  /// `program` says which program this is, in whatever form; the folder is made when it is needed.
  CheckCache(std::filesystem::path folder, std::string program);

  /// The kept result for a design with this text; nothing when there is none or it cannot be read.
  [[nodiscard]] std::optional<CheckedDesign> find(const std::string& design_text) const;
  /// Keeps results that are `is_final`. One that cannot be written is silently not kept.
  void keep(const std::string& design_text, const CheckedDesign& design) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(const std::string& design_text) const;

  std::filesystem::path folder_;
  std::string program_;
};

/// veritrack/check in the cache folder of the user, by the environment (XDG Base Directory Specification);
/// empty when there is none.
[[nodiscard]] std::filesystem::path default_cache_folder();

/// Which program this is, or the one in the file: its SHA-256, with the version; empty when they cannot be
/// found.
[[nodiscard]] std::string program_identity(const std::filesystem::path& file = "/proc/self/exe");

}  // namespace veritrack::reports
