// The fault of an input, its place, and what is allowed: one printable line.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "certificates/design/design.hpp"

namespace veritrack::certificates {

/// Thrown for an input that cannot be used. what() is one line, `file:line:column: what is wrong; what is
/// allowed`, without the line and column where there are none; the text of the input is made printable.
class InputError : public std::runtime_error {
 public:
  /// `position.line` is 0 where the fault has no place in the file. `message` is capped at kMessageLimit
  /// bytes.
  InputError(std::string_view file, Position position, std::string_view message);

  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] int line() const noexcept { return position_.line; }
  [[nodiscard]] int column() const noexcept { return position_.column; }
  /// Without file, line and column.
  [[nodiscard]] const std::string& message() const noexcept { return message_; }

  static constexpr std::size_t kMessageLimit = 600;

 private:
  std::string file_;
  Position position_;
  std::string message_;
};

/// `text` on one line, safe for a terminal: control characters, line separators, text-direction marks and
/// bytes that are not UTF-8 become \xNN or \uNNNN. Cut with "..." beyond `limit` bytes (at least 3).
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit);

/// The length in bytes of the UTF-8 character that `text` begins with; empty when it does not begin with one
/// (overlong forms, surrogates and values above U+10FFFF included) or is empty.
[[nodiscard]] std::optional<std::size_t> utf8_length(std::string_view text) noexcept;

}  // namespace veritrack::certificates
