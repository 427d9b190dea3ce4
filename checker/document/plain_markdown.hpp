// The text that a reader of a Markdown document sees, for the Markdown that the program writes and no other.
//
// A renderer knows many ways to show a word that is not in the text: tags, character references, links and
// emphasis inside a word, letters of another alphabet, TeX. Here only Markdown that the program writes is
// allowed, so that a reader sees the letters of the text without a few marks.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace veritrack::checker {

/// The name and source of a design, as a document quotes them: one line, of any letters.
std::string quotation_of(const std::string& name, const std::string& source);

/// The lines of a document outside its quotations, one after the other.
class PlainMarkdown {
 public:
  /// The reason why the line is refused: it contains something that the program does not write, or together
  /// with the letters of the lines before, whatever stands between them, it shows PROVED or REFUTED. Empty
  /// for a line that is allowed.
  [[nodiscard]] std::optional<std::string> objection_to(std::string_view line);
  /// Likewise of a line between fences, which is shown as it is; `is_math`: as TeX.
  [[nodiscard]] std::optional<std::string> objection_to_fenced(std::string_view line, bool is_math);
  /// A line that is read elsewhere; it separates the letters before it from those behind.
  void skip_line() { seen_.clear(); }

 private:
  [[nodiscard]] std::optional<std::string> objection_to_seen();

  std::string seen_;  ///< letters and digits
};

}  // namespace veritrack::checker
