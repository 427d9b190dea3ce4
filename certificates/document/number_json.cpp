#include "certificates/document/number_json.hpp"

#include <string>

namespace veritrack::certificates {

namespace {

/// Without the sign of a zero: as a bound -0 is 0, and which of both comes out depends on how an interval is
/// kept, which must not show in a certificate.
std::string hexadecimal_bound(double bound) {
  return rigor::to_hexadecimal(bound == 0.0 ? 0.0 : bound);
}

}  // namespace

Json enclosure_json(const rigor::Interval& value) {
  return {{"lo", hexadecimal_bound(value.lower())}, {"hi", hexadecimal_bound(value.upper())}};
}

Json readable_enclosure_json(const rigor::Interval& value) {
  Json json = enclosure_json(value);
  json["decimal"] = rigor::to_decimal(value);
  return json;
}

Json number_json(const Number& number) {
  Json json{{"text", number.text}};
  json.update(enclosure_json(number.tight));
  return json;
}

void add_number(Json& json, const char* name, const std::optional<Number>& number) {
  if (number) {
    json[name] = number_json(*number);
  }
}

}  // namespace veritrack::certificates
