// Parts of certificates by gains for tests.
#pragma once

#include <array>
#include <cstdio>
#include <string>

#include "tests/checker/model/gain/gain_loops.hpp"

namespace veritrack::test {

/// A number of a design; the ends are a little wider than the decimal.
inline Json decimal(const std::string& text) {
  const checker::Ball value = checker::from_decimal(text);
  const auto hexadecimal = [](double x) {
    std::array<char, 64> written{};
    (void)std::snprintf(written.data(), written.size(), "%a", x);
    return std::string(written.data());
  };
  return {
      {"text", text}, {"lo", hexadecimal(value.lower_double())}, {"hi", hexadecimal(value.upper_double())}};
}

inline Json claim(const std::string& id, bool required, const Json& values) {
  Json result{{"id", id}, {"verdict", "proved"}, {"required", required}, {"evidence", Json::object()}};
  result.update(values);
  return result;
}

}  // namespace veritrack::test
