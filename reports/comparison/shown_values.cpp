#include "reports/comparison/shown_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>
#include <vector>

#include "analysis/rigor/decimal.hpp"
#include "certificates/design/input_error.hpp"

namespace veritrack::reports {

namespace {

using certificates::Measure;
using Json = nlohmann::ordered_json;

std::string shown(const Json& json, bool in_hertz, bool is_slew) {
  if (json.is_object() && json.contains("text")) {
    return json.at("text").get<std::string>() + (!in_hertz ? "" : is_slew ? " Hz per second" : " Hz");
  }
  std::vector<std::string> parts;
  if (json.is_object()) {
    for (const auto& [name, value] : json.items()) {
      parts.push_back(fmt::format("{} = {}", name, shown(value, in_hertz, is_slew)));
    }
    return fmt::format("{{ {} }}", fmt::join(parts, ", "));
  }
  if (json.is_array()) {
    for (const Json& each : json) {
      parts.push_back(each.is_object() && each.contains("formula")
                          ? fmt::format("{} = {}", each.at("name").get<std::string>(),
                                        each.at("formula").get<std::string>())
                          : shown(each, in_hertz, is_slew));
    }
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  return json.is_string() ? json.get<std::string>() : json.dump();
}

std::vector<std::string> lines_of(const Json& json) {
  std::istringstream stream(json.get<std::string>());
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// The first line that differs of two texts.
std::string shown_lines(const Json& before, const Json& after) {
  const std::vector<std::string> from = lines_of(before);
  const std::vector<std::string> to = lines_of(after);
  std::size_t line = 0;
  while (line < from.size() && line < to.size() && from[line] == to[line]) {
    ++line;
  }
  const auto text = [&](const std::vector<std::string>& lines) {
    constexpr std::size_t kLongest = 80;
    const std::string found = line < lines.size() ? lines[line] : std::string();
    const auto begin = found.find_first_not_of(" \t");
    return begin == std::string::npos ? std::string("nothing")
                                      : certificates::printable(found.substr(begin), kLongest);
  };
  return fmt::format("line {}: {} -> {}", line + 1, text(from), text(to));
}

/// The value in rad/sample, where the other one is not in Hz.
std::string in_radians(const ContractValue& value, Measure measure) {
  const auto number = measured(*value.json, value, measure);
  if (!number || !number->written_in_hertz || !number->sampled) {
    return {};
  }
  constexpr int kDigits = 6;
  return fmt::format(" = {} {}", rigor::to_decimal(*number->sampled, kDigits),
                     measure == Measure::slew ? "rad/sample per sample" : "rad/sample");
}

bool is_written_in_hertz(const ContractValue& value, Measure measure) {
  if (measure != Measure::frequency && measure != Measure::slew) {
    return false;
  }
  const Json& json = value.json->is_array() && !value.json->empty() ? value.json->front() : *value.json;
  const auto number = measured(json, value, measure);
  return number && number->written_in_hertz;
}

}  // namespace

std::string shown_values(const ContractValue& before, const ContractValue& after,
                         certificates::Measure measure) {
  const bool has_both = before.json != nullptr && after.json != nullptr;
  const auto is_text = [](const Json& json) {
    return json.is_string() && json.get<std::string>().find('\n') != std::string::npos;
  };
  if (has_both && (is_text(*before.json) || is_text(*after.json)) && before.json->is_string() &&
      after.json->is_string()) {
    return shown_lines(*before.json, *after.json);
  }
  const bool in_two_units =
      has_both && is_written_in_hertz(before, measure) != is_written_in_hertz(after, measure);
  const auto text = [&](const ContractValue& value) {
    constexpr std::size_t kLongest = 160;
    if (value.json == nullptr) {
      return std::string("not given");
    }
    std::string written =
        certificates::printable(shown(*value.json, value.in_hertz, measure == Measure::slew), kLongest);
    if (!in_two_units) {
      return written;
    }
    return is_written_in_hertz(value, measure)
               ? written + in_radians(value, measure)
               : written + (measure == Measure::slew ? " rad/sample per sample" : " rad/sample");
  };
  return fmt::format("{} -> {}", text(before), text(after));
}

}  // namespace veritrack::reports
