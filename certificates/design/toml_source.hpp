// A TOML file: its text, and its tree by toml++.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/design/design.hpp"

namespace veritrack::certificates {

/// A parsed file beside the text that it came from: numbers are taken from the text, not from the parser.
class TomlSource {
 public:
  /// The author of these words: the user, or our own default values, which have no position to report.
  enum class Origin { file, built_in };

  /// Parses `text` (copied). `file_name` is for messages. Throws InputError for text that is not TOML 1.0,
  /// for invalid UTF-8, and for text that is empty, larger than kSizeLimit, or nested beyond any use.
  TomlSource(std::string_view text, std::string_view file_name, Origin origin = Origin::file);
  /// A table of a file as if it were a file: positions are still those in `outer`, and messages begin with
  /// the name of the table. The table must outlive it.
  TomlSource(const TomlSource& outer, const toml::table& table, std::string name);
  TomlSource(const TomlSource&) = delete;
  TomlSource& operator=(const TomlSource&) = delete;
  TomlSource(TomlSource&&) = delete;
  TomlSource& operator=(TomlSource&&) = delete;
  ~TomlSource() = default;

  /// As it was given, for messages.
  [[nodiscard]] const std::string& file_name() const { return file_name_; }
  [[nodiscard]] const toml::table& root() const noexcept { return table_ != nullptr ? *table_ : root_; }
  [[nodiscard]] Origin origin() const noexcept { return origin_; }
  /// The rest of the line of `position` from there on; empty behind its end, and when there is no such line.
  [[nodiscard]] std::string_view text_from(Position position) const;
  /// Just behind the last character.
  [[nodiscard]] Position end() const;
  /// Throws InputError with the file's name.
  [[noreturn]] void fail(Position position, std::string_view message) const;

  static constexpr std::size_t kSizeLimit = std::size_t{1} << 20;  // bytes

 private:
  void require_utf8() const;
  void require_ascii_after_line_continuations() const;
  [[nodiscard]] toml::table parse(std::string_view text) const;

  std::string text_;
  std::string file_name_;
  Origin origin_;
  std::vector<std::string_view> lines_;  // of text_, without the line feeds
  toml::table root_;
  const toml::table* table_ = nullptr;  // in place of root_
  std::string table_name_;
};

/// The same position, in our words.
[[nodiscard]] Position to_position(const toml::source_position& position) noexcept;

}  // namespace veritrack::certificates
