// From the files of [code] to a listing: clang compiles them, and veritrack-lift executes what it made with
// symbols. Nothing of the user's is run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/model/code/arc_tangent.hpp"
#include "certificates/code/recursion.hpp"
#include "certificates/design/design.hpp"
#include "trackers/code/listing.hpp"

namespace veritrack::certificates::code {

/// [code] of a design file.
struct CodeTable {
  Position position;  ///< of the table; line 0: there is none
  std::vector<SourceText> files;
  std::vector<SourceText> flags;

  [[nodiscard]] bool is_given() const { return !files.empty(); }
};

/// A file of the user's, by its name from the folder of the design and what it holds.
struct CodeFile {
  std::string name;
  std::string sha256;
  bool is_included = false;  ///< by others, and not named in the design
};

struct CompiledCode {
  std::vector<CodeFile> files;
  std::string compiler;  ///< as it names itself
  std::string listing_text;
  trackers::code::Listing listing;
  std::optional<model::code::ArcTangent> arc_tangent;  ///< that the program computes by itself
  trackers::code::Listing replaced;                    ///< the listing with an atan2 there
  Recursion recursion;                                 ///< of that
};

/// The listing of the functions setup, step and frequency. `design_file` is where the names of files begin.
/// Throws InputError, at a place of the design or of a source file.
[[nodiscard]] CompiledCode compiled(const CodeTable& code, const std::filesystem::path& design_file);

}  // namespace veritrack::certificates::code
