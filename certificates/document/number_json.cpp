#include "certificates/document/number_json.hpp"

namespace veritrack::certificates {

Json enclosure_json(const rigor::Interval& value) {
  return {{"lo", rigor::to_hexadecimal(value.lower())}, {"hi", rigor::to_hexadecimal(value.upper())}};
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
