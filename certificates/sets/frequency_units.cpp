#include "certificates/sets/frequency_units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::certificates {

using rigor::Interval;

namespace {

constexpr int kDigitsOfDecimals = 3;

}  // namespace

Interval FrequencyUnits::in_hertz(const Interval& radians) const {
  const rigor::UpwardRounding upward;
  return radians * sample_rate_->value().value / (Interval(2.0) * rigor::pi());
}

double FrequencyUnits::drawn(double radians) const {
  return has_hertz() ? radians * sample_rate_->value().nearest / (2.0 * std::numbers::pi) : radians;
}

std::string FrequencyUnits::at_most(const Interval& radians, int digits) const {
  if (!std::isfinite(radians.upper())) {
    return "unknown";
  }
  return rigor::upper_decimal(radians, digits) + " rad/sample" +
         (has_hertz()
              ? fmt::format(" ({} Hz)", rigor::upper_decimal(in_hertz(Interval(radians.upper())), digits))
              : "");
}

std::string FrequencyUnits::at_least(const Interval& radians, int digits) const {
  if (!std::isfinite(radians.lower())) {
    return "unknown";
  }
  return rigor::lower_decimal(radians, digits) + " rad/sample" +
         (has_hertz()
              ? fmt::format(" ({} Hz)", rigor::lower_decimal(in_hertz(Interval(radians.lower())), digits))
              : "");
}

std::string FrequencyUnits::slew(const Interval& radians, int digits) const {
  std::string text = rigor::lower_decimal(radians, digits) + " rad/sample per sample";
  if (has_hertz()) {
    const rigor::UpwardRounding upward;
    const Interval per_second = in_hertz(Interval(radians.lower())) * sample_rate_->value().value;
    text += fmt::format(" ({} Hz per second)", rigor::lower_decimal(per_second, digits));
  }
  return text;
}

std::string FrequencyUnits::at_most(double radians, int digits) const {
  return std::isfinite(radians) ? at_most(Interval(radians), digits) : "unknown";
}
std::string FrequencyUnits::at_least(double radians, int digits) const {
  return std::isfinite(radians) ? at_least(Interval(radians), digits) : "unknown";
}
std::string FrequencyUnits::slew(double radians, int digits) const {
  return slew(Interval(radians), digits);
}

std::string FrequencyUnits::at_most(const std::string& decimal) const {
  return decimal + " rad/sample" +
         (has_hertz() ? fmt::format(" ({} Hz)", rigor::upper_decimal(in_hertz(rigor::parse_decimal(decimal)),
                                                                     kDigitsOfDecimals))
                      : "");
}

std::string FrequencyUnits::at_least(const std::string& decimal) const {
  return decimal + " rad/sample" +
         (has_hertz() ? fmt::format(" ({} Hz)", rigor::lower_decimal(in_hertz(rigor::parse_decimal(decimal)),
                                                                     kDigitsOfDecimals))
                      : "");
}

std::string FrequencyUnits::slew(const std::string& decimal) const {
  std::string text = decimal + " rad/sample per sample";
  if (has_hertz()) {
    const rigor::UpwardRounding upward;
    const Interval per_second = in_hertz(rigor::parse_decimal(decimal)) * sample_rate_->value().value;
    text += fmt::format(" ({} Hz per second)", rigor::lower_decimal(per_second, kDigitsOfDecimals));
  }
  return text;
}

std::string FrequencyUnits::between(const std::string& low, const std::string& high) const {
  std::string text = fmt::format("{} and {} rad/sample", low, high);
  if (!has_hertz()) {
    return text;
  }
  return fmt::format("{} ({} and {} Hz)", text,
                     rigor::lower_decimal(in_hertz(rigor::parse_decimal(low)), kDigitsOfDecimals),
                     rigor::upper_decimal(in_hertz(rigor::parse_decimal(high)), kDigitsOfDecimals));
}

std::string FrequencyUnits::sampled() const {
  return has_hertz() ? fmt::format(", sampled at {} Hz,", sample_rate_->value().text) : "";
}

std::string frequency_words(const Number& number) {
  return number.in_hertz ? number.text : number.text + " rad/sample";
}
std::string time_words(const Number& number) {
  return number.in_hertz ? number.text : number.text + " samples";
}
std::string slew_words(const Number& number) {
  return number.in_hertz ? number.text : number.text + " rad/sample per sample";
}

std::string outward(const Interval& range, int digits) {
  return rigor::is_finite(range) ? fmt::format("[{}, {}]", rigor::lower_decimal(range, digits),
                                               rigor::upper_decimal(range, digits))
                                 : "unknown";
}

}  // namespace veritrack::certificates
