#include "certificates/design/input_error.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace veritrack::certificates {

namespace {

constexpr std::size_t kFileNameLimit = 4096;

unsigned int byte_at(std::string_view text, std::size_t index) {
  return static_cast<unsigned char>(text[index]);
}

std::uint32_t decode(std::string_view character) {
  const unsigned int first = byte_at(character, 0);
  const std::size_t length = character.size();
  std::uint32_t value = length == 1 ? first : first & (0xFFU >> (length + 1));
  for (std::size_t index = 1; index < length; ++index) {
    value = value << 6U | (byte_at(character, index) & 0x3FU);
  }
  return value;
}

/// Characters that move the cursor, break the line or reorder the text around them.
bool is_unprintable(std::uint32_t value) {
  const bool is_control = value < 0x20 || (value >= 0x7F && value < 0xA0);
  const bool separates_lines = value == 0x2028 || value == 0x2029;
  const bool reorders = value == 0x061C || value == 0x200E || value == 0x200F ||
                        (value >= 0x202A && value <= 0x202E) || (value >= 0x2066 && value <= 0x2069);
  return is_control || separates_lines || reorders || value == 0xFEFF;
}

std::string what_text(std::string_view file, Position position, std::string_view message) {
  const std::string name = printable(file, kFileNameLimit);
  if (position.line > 0) {
    return fmt::format("{}:{}:{}: {}", name, position.line, position.column, message);
  }
  return fmt::format("{}: {}", name, message);
}

}  // namespace

std::optional<std::size_t> utf8_length(std::string_view text) noexcept {
  if (text.empty()) {
    return std::nullopt;
  }
  const unsigned int first = byte_at(text, 0);
  if (first < 0x80) {
    return 1;
  }
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) {
    return std::nullopt;
  }
  for (std::size_t index = 1; index < length; ++index) {
    if ((byte_at(text, index) & 0xC0U) != 0x80U) {
      return std::nullopt;
    }
  }
  const std::uint32_t value = decode(text.substr(0, length));
  const bool is_overlong = (length == 3 && value < 0x800) || (length == 4 && value < 0x10000);
  const bool is_surrogate = value >= 0xD800 && value <= 0xDFFF;
  if (is_overlong || is_surrogate || value > 0x10FFFF) {
    return std::nullopt;
  }
  return length;
}

std::string printable(std::string_view text, std::size_t limit) {
  constexpr std::string_view kCut = "...";
  std::string result;
  std::size_t room_for_cut = 0;  // the length of the longest part that leaves room for kCut
  while (!text.empty()) {
    const std::optional<std::size_t> length = utf8_length(text);
    const std::string_view character = text.substr(0, length.value_or(1));
    text.remove_prefix(character.size());
    if (!length) {
      result += fmt::format("\\x{:02X}", byte_at(character, 0));
    } else if (const std::uint32_t value = decode(character); is_unprintable(value)) {
      result += value < 0x80 ? fmt::format("\\x{:02X}", value) : fmt::format("\\u{:04X}", value);
    } else {
      result += character;
    }
    if (result.size() > limit) {
      result.resize(room_for_cut);
      return result.append(kCut);
    }
    if (result.size() + kCut.size() <= limit) {
      room_for_cut = result.size();
    }
  }
  return result;
}

InputError::InputError(std::string_view file, Position position, std::string_view message)
    : std::runtime_error(what_text(file, position, printable(message, kMessageLimit))),
      file_(file),
      position_(position),
      message_(printable(message, kMessageLimit)) {}

}  // namespace veritrack::certificates
