// The tables of a KKL observer's design file, and what no such design can be.
#include "checker/kkl_observer/kkl_design.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <string>

namespace {

using namespace veritrack::checker;

/// A number that a double is exactly.
std::string number(double value) {
  char text[200];
  std::snprintf(text, sizeof text, R"({"text": "%g", "lo": "%a", "hi": "%a", "decimal": "[%g, %g]"})", value,
                value, value, value, value);
  return text;
}
std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "[" : ", ") + number(value);
  }
  return text + "]";
}

/// How many objections there are to a design with this disturbance.
std::size_t objections(const std::string& disturbance, const std::vector<double>& rates = {1, 2, 3, 4},
                       const std::vector<double>& frequency = {2, 4}) {
  Objections found;
  read_kkl_design(read_json(R"({"design": {"lambda": )" + list(rates) + R"(}, "assume": {"frequency": )" +
                            list(frequency) + R"(, "amplitude": )" + list({1, 2}) + disturbance + "}}"),
                  found);
  return found.size();
}
std::string disturbance(const std::string& members) {
  return R"(, "disturbance": {)" + members + "}";
}

}  // namespace

TEST_CASE("a frequency that no double above zero is below") {
  Objections found;
  const std::string tiny =
      R"({"text": "4e-324", "lo": "0x0p+0", "hi": "0x0.0000000000001p-1022", "decimal": "[0, 5e-324]"})";
  read_kkl_design(
      read_json(R"({"design": {"lambda": )" + list({1, 2, 3, 4}) + R"(}, "assume": {"frequency": [)" + tiny +
                "," + number(1) + R"(], "amplitude": )" + list({1, 2}) + "}}"),
      found);
  CHECK(found.size() == 1);
}

TEST_CASE("designs that can be, and that cannot") {
  const std::string amplitude = R"("amplitude": )" + number(0.25);
  const std::string frequency = R"("frequency": )" + number(100);
  const std::string bound = R"("bound": )" + number(0.5);
  CHECK(objections("") == 0);
  CHECK(objections(disturbance(bound)) == 0);
  CHECK(objections(disturbance(amplitude + ", " + frequency)) == 0);
  CHECK(objections("", {1, 2, 3, 4, 5}) == 0);
  CHECK(objections("", {1, 2, 3, 4, 5, 6, 7, 8}) == 0);
  CHECK(objections("", {1, 2, 3, 4, 5, 6, 7, 8, 9}) > 0);
  for (const std::string& members :
       {std::string(), amplitude, frequency, bound + ", " + amplitude,
        bound + ", " + amplitude + ", " + frequency, R"("bound": )" + number(-0.5)}) {
    CHECK_MESSAGE(objections(disturbance(members)) > 0, members);
  }
  CHECK_THROWS_AS(objections(disturbance(amplitude + R"(, "phase": )" + number(1))), Malformed);
  CHECK(objections("", {1, 2, 3}) > 0);
  CHECK(objections("", {0, 1, 2, 3}) > 0);
  CHECK(objections("", {1, 2, 3, 4}, {4, 2}) > 0);
  CHECK(objections("", {1, 2, 3, 4}, {0, 2}) > 0);
  CHECK_THROWS_AS(objections("", {1, 2, 3, 4}, {2}), Malformed);
}
