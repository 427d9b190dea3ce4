// Texts that are part of the program: files of the columns for people, included by CMake.
#pragma once

#include <string_view>
#include <vector>

namespace veritrack::certificates {

/// A file: its path from the root of the sources, and its content.
struct EmbeddedText {
  std::string_view name, text;
};

/// certificates/*/*explanations.toml: the meanings of keys and claims.
[[nodiscard]] const std::vector<EmbeddedText>& explanation_texts();
/// certificates/*/new.toml: a design file to begin with for each tracker.
[[nodiscard]] const std::vector<EmbeddedText>& design_templates();

}  // namespace veritrack::certificates
