#include "certificates/design/toml_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/input_error.hpp"

namespace veritrack::certificates {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Every dot of a dotted key opens a table, and toml++ frees nested tables by recursion: a key of 500,000
// parts, which fits into the size limit, would exhaust the stack. Dots elsewhere are few in any design file.
constexpr std::ptrdiff_t kDotLimit = 5000;

constexpr std::string_view kBlanks = " \t\r";

bool is_ascii(char byte) {
  return static_cast<unsigned char>(byte) < 0x80;
}

// toml++ 3.3.0 runs into undefined behaviour (its issue 190) where a character that is not ASCII occurs
// outside strings and comments, and behind a backslash that joins two lines of a string. It therefore first
// gets the text with a question mark, which is equally invalid in those places, for each such character; a
// text that is then well-formed has them in strings and comments only, and is parsed as it is. Positions are
// the same in both: columns count characters.
std::string to_ascii(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text).value_or(1);
    result += is_ascii(text.front()) ? text.front() : '?';
    text.remove_prefix(length);
  }
  return result;
}

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (true) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) {
      return lines;
    }
    text.remove_prefix(end + 1);
  }
}

/// The parser counts columns in characters, so do we. `offset` is in bytes.
int column_of(std::string_view line, std::size_t offset) {
  const auto is_first_byte = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; };
  return 1 + static_cast<int>(std::count_if(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(offset),
                                            is_first_byte));
}

/// The byte where column `column` of the line begins.
std::size_t offset_of(std::string_view line, int column) {
  std::size_t offset = 0;
  for (int passed = 1; passed < column && offset < line.size(); ++passed) {
    offset += utf8_length(line.substr(offset)).value_or(1);
  }
  return offset;
}

/// The parser's sentence without its preamble: it begins "Error while parsing floating-point: ".
std::string parser_message(const toml::parse_error& error) {
  std::string_view text = error.description();
  constexpr std::string_view kPreamble = "Error while parsing ";
  if (text.starts_with(kPreamble)) {
    text.remove_prefix(kPreamble.size());
  }
  const bool is_about_number = text.starts_with("floating-point") || text.starts_with("decimal integer") ||
                               text.find("numeric value") != std::string_view::npos;
  return fmt::format(
      "cannot be read as TOML: {}; allowed: {}", printable(text, InputError::kMessageLimit / 2),
      is_about_number ? "decimal numbers of up to 120 characters in the range of double precision"
                      : "TOML 1.0");
}

}  // namespace

Position to_position(const toml::source_position& position) noexcept {
  return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

TomlSource::TomlSource(std::string_view text, std::string_view file_name, Origin origin)
    : file_name_(file_name), origin_(origin) {
  if (text.starts_with(kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
  }
  if (text.empty()) {
    fail({1, 1}, "the file is empty; allowed: a design file with name, tracker, [design] and [assume]");
  }
  if (text.size() > kSizeLimit) {
    fail({},
         fmt::format("the file has more than {} bytes; allowed: a design file of up to 1 MiB", kSizeLimit));
  }
  text_ = text;
  lines_ = split_lines(text_);
  require_utf8();
  if (std::count(text_.begin(), text_.end(), '.') > kDotLimit) {
    fail({}, fmt::format("more than {} dots in the file; allowed: a design file of few, shallow tables",
                         kDotLimit));
  }
  root_ = parse(to_ascii(text_));
  if (std::any_of(text_.begin(), text_.end(), [](char byte) { return !is_ascii(byte); })) {
    require_ascii_after_line_continuations();
    root_ = parse(text_);
  }
}

TomlSource::TomlSource(const TomlSource& outer, const toml::table& table, std::string name)
    : text_(outer.text_),
      file_name_(outer.file_name_),
      origin_(outer.origin_),
      lines_(split_lines(text_)),
      table_(&table),
      table_name_(std::move(name)) {}

toml::table TomlSource::parse(std::string_view text) const {
  try {
    const rigor::NearestRounding nearest;
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const Position position = to_position(error.source().begin);
    const std::string_view rest = text_from(position);
    const std::string_view character = rest.substr(0, utf8_length(rest).value_or(0));
    if (!character.empty() && !is_ascii(character.front())) {
      fail(
          position,
          fmt::format(
              "\"{}\" occurs where TOML allows only ASCII; allowed: other characters in strings and comments",
              character));
    }
    fail(position, parser_message(error));
  }
}

void TomlSource::require_ascii_after_line_continuations() const {
  for (std::size_t index = 0; index + 1 < lines_.size(); ++index) {
    const std::size_t last = lines_[index].find_last_not_of(kBlanks);
    if (last == std::string_view::npos || lines_[index][last] != '\\') {
      continue;
    }
    std::size_t next = index + 1;
    while (next + 1 < lines_.size() && lines_[next].find_first_not_of(kBlanks) == std::string_view::npos) {
      ++next;
    }
    const std::size_t first = lines_[next].find_first_not_of(kBlanks);
    if (first != std::string_view::npos && !is_ascii(lines_[next][first])) {
      fail({static_cast<int>(next) + 1, column_of(lines_[next], first)},
           "a character that is not ASCII follows a backslash at the end of a line; allowed: it in the "
           "middle of a line");
    }
  }
}

void TomlSource::require_utf8() const {
  for (std::size_t index = 0; index < lines_.size(); ++index) {
    const std::string_view line = lines_[index];
    std::size_t offset = 0;
    while (offset < line.size()) {
      const std::optional<std::size_t> length = utf8_length(line.substr(offset));
      if (!length) {
        const Position position{static_cast<int>(index) + 1, column_of(line, offset)};
        fail(position, fmt::format("byte 0x{:02X} is not valid UTF-8; allowed: a text file in UTF-8",
                                   static_cast<unsigned char>(line[offset])));
      }
      offset += *length;
    }
  }
}

std::string_view TomlSource::text_from(Position position) const {
  if (position.line < 1 || static_cast<std::size_t>(position.line) > lines_.size()) {
    return {};
  }
  std::string_view line = lines_[static_cast<std::size_t>(position.line) - 1];
  line.remove_prefix(offset_of(line, position.column));
  return line;
}

Position TomlSource::end() const {
  return {static_cast<int>(lines_.size()), column_of(lines_.back(), lines_.back().size())};
}

void TomlSource::fail(Position position, std::string_view message) const {
  throw InputError(
      file_name_, position,
      table_name_.empty() ? std::string(message) : fmt::format("in [{}]: {}", table_name_, message));
}

}  // namespace veritrack::certificates
