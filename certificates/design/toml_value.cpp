#include "certificates/design/toml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/design/input_error.hpp"

namespace veritrack::certificates {

namespace {

constexpr std::size_t kShownLimit = 60;  // bytes of a value that are worth showing

/// One more unit in the last place on both sides, where it is not a point.
rigor::Interval with_room(const rigor::Interval& tight) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double lower = std::nextafter(tight.lower(), -kInfinity);
  const double upper = std::nextafter(tight.upper(), kInfinity);
  const bool has_room = tight.lower() < tight.upper() && std::isfinite(lower) && std::isfinite(upper);
  return has_room ? rigor::Interval::from_bounds(lower, upper) : tight;
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

Position TomlValue::position() const {
  return to_position(node_->source().begin);
}

TomlSource TomlValue::as_file() const {
  if (!node_->is_table()) {
    refuse_kind();
  }
  return {*source_, *node_->as_table(), path_};
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
  const std::string_view text = source_->text_from(position());
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
    number.tight = rigor::parse_decimal(decimal);
    // A number just inside the allowed range stays inside: 1e-400 is not negative.
    const rigor::Interval wider = with_room(number.tight);
    number.value = is_allowed(wider) ? wider : number.tight;
  } catch (const rigor::NumberFormatError&) {
    refuse(shown + ", not a decimal number in the range of double precision");
  }
  number.nearest = rigor::nearest_double(decimal);
  // The text was cut out by position: it must be the number that the parser saw there.
  const double parsed = node_->is_integer()
                            ? rigor::nearest_double(std::to_string(node_->as_integer()->get()))
                            : node_->as_floating_point()->get();
  if (parsed != number.nearest || !rigor::contains(number.tight, number.nearest)) {
    refuse(shown + ", which two readers understand differently");
  }
  if (!is_allowed(number.tight)) {
    const bool is_borderline = is_allowed(rigor::Interval(number.tight.lower())) ||
                               is_allowed(rigor::Interval(number.tight.upper()));
    refuse(is_borderline ? shown + ", too close to the limit to decide in double precision" : shown);
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

SourceText TomlValue::source_text(std::size_t limit) const {
  if (node_->is_number()) {
    return {std::string(number_text()), position()};
  }
  const auto* value = node_->as_string();
  if (value == nullptr) {
    refuse_kind();
  }
  SourceText source{value->get(), position()};
  if (source.text.size() > limit) {
    refuse(fmt::format("{} bytes long", source.text.size()));
  }
  const std::string_view raw = source_->text_from(source.position);
  const std::size_t quotes = raw.starts_with("\'\'\'") || raw.starts_with("\"\"\"") ? 3 : 1;
  source.position.column += static_cast<int>(quotes);
  std::string_view first_line = raw.substr(std::min(quotes, raw.size()));
  if (quotes == 3 && (first_line.empty() || first_line == "\r")) {
    source.position = {source.position.line + 1, 1};  // TOML leaves out a line feed behind the quotes
    first_line = source_->text_from(source.position);
  }
  // With escapes, the text differs from that in the file.
  const bool is_as_written = raw.starts_with('\'') || raw.find('\\') == std::string_view::npos;
  const std::string_view text_line =
      std::string_view(source.text).substr(0, source.text.find_first_of("\r\n"));
  if (!is_as_written || !first_line.starts_with(text_line) || (quotes == 3 && raw.starts_with('"'))) {
    refuse(
        "with escapes, or in three double quotes, so that its characters have no place in the file; write it "
        "between single quotes");
  }
  return source;
}

std::vector<std::pair<SourceText, TomlValue>> TomlValue::members() const {
  const toml::table* table = node_->as_table();
  if (table == nullptr) {
    refuse_kind();
  }
  std::vector<std::pair<SourceText, TomlValue>> members;
  members.reserve(table->size());
  for (const auto& [key, node] : *table) {
    const std::string name(key.str());
    members.emplace_back(SourceText{name, to_position(key.source().begin)},
                         TomlValue(*source_, node, fmt::format("{}.{}", path_, name), allowed_));
  }
  std::sort(members.begin(), members.end(), [](const auto& a, const auto& b) {
    const Position& first = a.first.position;
    const Position& second = b.first.position;
    return std::tie(first.line, first.column) < std::tie(second.line, second.column);
  });
  return members;
}

std::vector<TomlValue> TomlValue::entries(std::span<const std::string_view> names) const {
  const toml::table* table = node_->as_table();
  if (table == nullptr) {
    refuse_kind();
  }
  std::vector<TomlValue> entries;
  entries.reserve(names.size());
  for (const std::string_view name : names) {
    const toml::node* node = table->get(name);
    if (node == nullptr || table->size() != names.size()) {
      refuse("a table with other keys");
    }
    entries.emplace_back(*source_, *node, fmt::format("{}.{}", path_, name), allowed_);
  }
  return entries;
}

std::vector<TomlValue> TomlValue::elements(std::size_t count) const {
  return elements(count, count);
}

std::vector<TomlValue> TomlValue::elements(std::size_t fewest, std::size_t most) const {
  const toml::array* array = node_->as_array();
  if (array == nullptr) {
    refuse_kind();
  }
  if (array->size() < fewest || array->size() > most) {
    refuse(fmt::format("an array of {}", array->size()));
  }
  std::vector<TomlValue> elements;
  elements.reserve(array->size());
  for (std::size_t index = 0; index < array->size(); ++index) {
    elements.emplace_back(*source_, *array->get(index), fmt::format("{}[{}]", path_, index), allowed_);
  }
  return elements;
}

std::optional<std::vector<TomlValue>> TomlValue::fields(const std::vector<std::string_view>& keys) const {
  const toml::table* table = node_->as_table();
  if (table == nullptr) {
    refuse_kind();
  }
  if (table->size() != keys.size()) {
    return std::nullopt;
  }
  std::vector<TomlValue> values;
  values.reserve(keys.size());
  for (const std::string_view key : keys) {
    const toml::node* node = table->get(key);
    if (node == nullptr) {
      return std::nullopt;
    }
    values.emplace_back(*source_, *node, fmt::format("{}.{}", path_, key), allowed_);
  }
  return values;
}

std::optional<TomlValue> TomlValue::elsewhere(std::string_view table, std::string_view key,
                                              std::string_view allowed) const {
  const toml::table* content = source_->root().get_as<toml::table>(table);
  const toml::node* node = content != nullptr ? content->get(key) : nullptr;
  return node != nullptr
             ? std::optional(TomlValue(*source_, *node, fmt::format("{}.{}", table, key), allowed))
             : std::nullopt;
}

}  // namespace veritrack::certificates
