#include "reports/comparison/measured_number.hpp"

#include <string>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack::reports {

namespace {

using certificates::Measure;
using rigor::Interval;
using Json = nlohmann::ordered_json;

/// The number in front of a unit; nothing when the text has another end.
std::optional<Interval> decimal_before(const std::string& text, std::string_view unit) {
  return text.ends_with(unit) ? decimal_in(std::string_view(text).substr(0, text.size() - unit.size()))
                              : std::nullopt;
}

Measured measured_frequency(const Json& json, const Interval& number, const ContractValue& context,
                            bool is_slew) {
  Measured found;
  std::optional<Interval> to_hertz;
  if (context.sample_rate) {
    const Interval& rate = *context.sample_rate;
    to_hertz = (is_slew ? Interval(rate * rate) : rate) / (Interval(2.0) * rigor::pi());
  }
  if (context.in_hertz) {
    found.written_in_hertz = true;
    found.physical = number;
    found.sampled = to_hertz ? std::optional(Interval(number / *to_hertz)) : std::nullopt;
    return found;
  }
  found.sampled = number;
  found.physical = decimal_before(json.at("text").get<std::string>(), is_slew ? " Hz per second" : " Hz");
  found.written_in_hertz = found.physical.has_value();
  if (!found.physical && to_hertz) {
    found.physical = number * *to_hertz;
  }
  return found;
}

}  // namespace

std::optional<Interval> decimal_in(std::string_view text) {
  try {
    return rigor::parse_decimal(text);
  } catch (const rigor::NumberFormatError&) {
    return std::nullopt;
  }
}

std::optional<Interval> number_in(const Json& json) {
  if (!json.is_object() || !json.contains("text") || !json.contains("lo") || !json.contains("hi")) {
    return std::nullopt;
  }
  try {
    const double low = rigor::parse_hexadecimal(json.at("lo").get<std::string>()).lower();
    const double high = rigor::parse_hexadecimal(json.at("hi").get<std::string>()).upper();
    return low <= high ? std::optional(Interval::from_bounds(low, high)) : std::nullopt;
  } catch (const rigor::NumberFormatError&) {
    return std::nullopt;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::optional<Measured> measured(const Json& json, const ContractValue& context, Measure measure) {
  const std::optional<Interval> number = number_in(json);
  if (!number) {
    return std::nullopt;
  }
  switch (measure) {
    case Measure::frequency:
    case Measure::slew:
      return measured_frequency(json, *number, context, measure == Measure::slew);
    case Measure::samples:
      return Measured{number, context.sample_rate ? std::optional(Interval(*number / *context.sample_rate))
                                                  : std::nullopt};
    case Measure::plain:
      break;
  }
  return Measured{number};
}

}  // namespace veritrack::reports
