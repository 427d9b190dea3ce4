#include "certificates/sets/frequency_units.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::certificates;

Number number(const char* text) {
  const rigor::UpwardRounding upward;
  Number result;
  result.text = text;
  result.tight = result.value = rigor::parse_decimal(text);
  result.nearest = rigor::nearest_double(text);
  return result;
}

TEST_CASE("rad/sample alone without a sample rate, and Hz beside it with one") {
  const std::optional<Number> none;
  const std::optional<Number> rate = number("8000");
  CHECK(FrequencyUnits(none).at_most(0.25) == "0.25 rad/sample");
  // 0.25 * 8000/(2 pi) = 318.3098861837907
  CHECK(FrequencyUnits(rate).at_most(0.25) == "0.25 rad/sample (318.4 Hz)");
  CHECK(FrequencyUnits(rate).at_least(0.25) == "0.25 rad/sample (318.3 Hz)");
  CHECK(FrequencyUnits(rate).at_most(0.25, 3) == "0.25 rad/sample (319 Hz)");
  // 2^-20 * 8000^2/(2 pi) = 9.714046...
  CHECK(FrequencyUnits(rate).slew(0x1p-20) == "9.536e-7 rad/sample per sample (9.714 Hz per second)");
  CHECK(FrequencyUnits(none).sampled().empty());
  CHECK(FrequencyUnits(rate).sampled() == ", sampled at 8000 Hz,");
}

TEST_CASE("decimals of sentences: rounded outward, with their sign") {
  const std::optional<Number> rate = number("1000");
  // 0.01563 * 1000/(2 pi) = 2.487591... and 0.001/(2 pi) * 1000 = 0.1591549...
  CHECK(FrequencyUnits(rate).at_most("0.01563") == "0.01563 rad/sample (2.49 Hz)");
  CHECK(FrequencyUnits(rate).at_least("0.01563") == "0.01563 rad/sample (2.48 Hz)");
  CHECK(FrequencyUnits(rate).between("-0.001", "0.001") == "-0.001 and 0.001 rad/sample (-0.16 and 0.16 Hz)");
}

TEST_CASE("the rounding mode of the caller does not matter") {
  const std::optional<Number> rate = number("8000");
  const std::string nearest = FrequencyUnits(rate).at_most(0.3);
  const rigor::UpwardRounding upward;
  CHECK(FrequencyUnits(rate).at_most(0.3) == nearest);
}

TEST_CASE("what is not finite is unknown") {
  const std::optional<Number> rate = number("8000");
  for (const double value :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    CHECK(FrequencyUnits(rate).at_most(value) == "unknown");
    CHECK(FrequencyUnits(rate).at_least(value) == "unknown");
  }
}

TEST_CASE("a number of the design says its unit") {
  Number slew = number("200");
  CHECK(slew_words(slew) == "200 rad/sample per sample");
  slew.text = "200 Hz per second";
  slew.in_hertz = true;
  CHECK(slew_words(slew) == "200 Hz per second");
  CHECK(frequency_words(number("0.5")) == "0.5 rad/sample");
}

}  // namespace
