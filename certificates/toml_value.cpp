#include "certificates/toml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::certificates {

namespace {

constexpr std::size_t kShownLimit = 60;  // bytes of a value or a parser's message that are worth showing
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Every dot of a dotted key opens a table, and toml++ frees nested tables by recursion: a key of 500,000
// parts, which fits into the size limit, would exhaust the stack. Dots elsewhere are few in any design file.
constexpr std::ptrdiff_t kDotLimit = 5000;

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

/// The double nearest to a decimal that parse_decimal has accepted.
double nearest_double(std::string_view decimal) {
  const rigor::NearestRounding nearest;
  if (decimal.starts_with('+')) {
    decimal.remove_prefix(1);
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(decimal.data(), decimal.data() + decimal.size(), value);
  if (error == std::errc::result_out_of_range) {
    return decimal.starts_with('-') ? -0.0 : 0.0;  // parse_decimal has refused what is too large
  }
  const bool read_whole = error == std::errc() && end == decimal.data() + decimal.size();
  return read_whole ? value : std::numeric_limits<double>::quiet_NaN();
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

std::string_view kind_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number with a fraction";
    case toml::node_type::boolean:
      return "a boolean";
    case toml::node_type::date:
    case toml::node_type::time:
    case toml::node_type::date_time:
      return "a date or time";
    case toml::node_type::none:
      break;
  }
  return "nothing";
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
  try {
    const rigor::NearestRounding nearest;
    root_ = toml::parse(std::string_view(text_));
  } catch (const toml::parse_error& error) {
    fail(to_position(error.source().begin), parser_message(error));
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

std::string_view TomlSource::line(int number) const {
  return lines_.at(static_cast<std::size_t>(number) - 1);
}

Position TomlSource::end() const {
  return {static_cast<int>(lines_.size()), column_of(lines_.back(), lines_.back().size())};
}

void TomlSource::fail(Position position, std::string_view message) const {
  throw InputError(file_name_, position, message);
}

Position TomlValue::position() const {
  return to_position(node_->source().begin);
}

void TomlValue::refuse(std::string_view found) const {
  source_->fail(position(), fmt::format("{} is {}; allowed: {}", path_, found, allowed_));
}

void TomlValue::refuse_kind() const {
  std::string found(kind_name(*node_));
  if (const auto* text = node_->as_string()) {
    found += fmt::format(" (\"{}\")", printable(text->get(), kShownLimit));
  }
  refuse(found);
}

std::string_view TomlValue::number_text() const {
  const Position begin = position();
  std::string_view text = source_->line(begin.line);
  text.remove_prefix(offset_of(text, begin.column));
  constexpr std::string_view kNumberCharacters =
      "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_+-.";
  return text.substr(0, text.find_first_not_of(kNumberCharacters));
}

Number TomlValue::real(RealPredicate is_allowed) const {
  if (!node_->is_number()) {
    refuse_kind();
  }
  Number number;
  number.text = number_text();
  number.position = source_->origin() == TomlSource::Origin::file ? position() : Position{};
  std::string decimal = number.text;
  std::erase(decimal, '_');
  const std::string shown = printable(number.text, kShownLimit);
  try {
    number.value = rigor::parse_decimal(decimal);
  } catch (const rigor::NumberFormatError&) {
    refuse(shown + ", not a decimal number in the range of double precision");
  }
  number.nearest = nearest_double(decimal);
  // The text was cut out by position: it must be the number that the parser saw there.
  const double parsed = node_->is_integer() ? nearest_double(std::to_string(node_->as_integer()->get()))
                                            : node_->as_floating_point()->get();
  if (parsed != number.nearest || !rigor::contains(number.value, number.nearest)) {
    refuse(shown + ", which two readers understand differently");
  }
  if (!is_allowed(number.value)) {
    const bool is_borderline = is_allowed(rigor::Interval(number.value.lower())) ||
                               is_allowed(rigor::Interval(number.value.upper()));
    refuse(is_borderline ? shown + ", too near to the limit to tell in double precision" : shown);
  }
  return number;
}

Number TomlValue::whole_number(RealPredicate is_allowed) const {
  if (node_->is_floating_point()) {
    refuse(printable(number_text(), kShownLimit));
  }
  return real(is_allowed);
}

std::int64_t TomlValue::integer(std::int64_t lowest, std::int64_t highest) const {
  if (node_->is_floating_point()) {
    refuse(printable(number_text(), kShownLimit));
  }
  const auto* value = node_->as_integer();
  if (value == nullptr) {
    refuse_kind();
  }
  if (value->get() < lowest || value->get() > highest) {
    refuse(printable(number_text(), kShownLimit));
  }
  return value->get();
}

std::string TomlValue::line_of_text(std::size_t limit) const {
  const auto* value = node_->as_string();
  if (value == nullptr) {
    refuse_kind();
  }
  const std::string& text = value->get();
  if (text.empty()) {
    refuse("empty");
  }
  if (text.size() > limit) {
    refuse(fmt::format("{} bytes long", text.size()));
  }
  // A character that has to be escaped has no place on one line of a document.
  if (printable(text, 8 * limit) != text) {
    refuse(fmt::format("\"{}\", with control characters", printable(text, kShownLimit)));
  }
  return text;
}

std::vector<TomlValue> TomlValue::elements(std::size_t count) const {
  const toml::array* array = node_->as_array();
  if (array == nullptr) {
    refuse_kind();
  }
  if (array->size() != count) {
    refuse(fmt::format("an array of {}", array->size()));
  }
  std::vector<TomlValue> elements;
  for (std::size_t index = 0; index < count; ++index) {
    elements.emplace_back(*source_, *array->get(index), fmt::format("{}[{}]", path_, index), allowed_);
  }
  return elements;
}

}  // namespace veritrack::certificates
