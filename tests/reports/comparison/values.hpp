// Values of designs as certificate.json has them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "certificates/document/number_json.hpp"

namespace veritrack::test {

/// A number as it is written.
inline nlohmann::ordered_json number(const std::string& text) {
  certificates::Number number;
  number.text = text;
  number.tight = rigor::parse_decimal(text);
  return certificates::number_json(number);
}

/// A number in Hz, whose ends are in rad/sample.
inline nlohmann::ordered_json hertz(const std::string& text, double radians) {
  certificates::Number number;
  number.text = text + " Hz";
  constexpr double kUlp = 1e-15;
  number.tight = rigor::Interval::from_bounds(radians * (1.0 - kUlp), radians * (1.0 + kUlp));
  return certificates::number_json(number);
}

}  // namespace veritrack::test
