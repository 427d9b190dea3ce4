#include "reports/comparison/shown_values.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/rounding.hpp"
#include "tests/reports/comparison/values.hpp"

namespace {

using namespace veritrack;           // NOLINT(google-build-using-namespace)
using namespace veritrack::reports;  // NOLINT(google-build-using-namespace)
using certificates::Measure;
using rigor::Interval;
using test::number;
using Json = nlohmann::ordered_json;

std::string shown(const Json& before, const Json& after, Measure measure = Measure::plain) {
  const rigor::UpwardRounding upward;
  return shown_values({&before}, {&after}, measure);
}

TEST_CASE("values are told as they are written") {
  CHECK(shown(number("40"), number("4e2")) == "40 -> 4e2");
  CHECK(shown(Json::array({number("0.1"), number("0.2")}), number("0.1")) == "[0.1, 0.2] -> 0.1");
  CHECK(shown(number("0.1"), Json{{"snr_db", number("17")}}) == "0.1 -> { snr_db = 17 }");
  CHECK(shown("steady-state", Json{{"from", number("1")}, {"to", number("2")}}) ==
        "steady-state -> { from = 1, to = 2 }");
  CHECK(shown("a\x1b[1m", "b") == "a\\x1B[1m -> b");
  const Json value = number("1");
  CHECK(shown_values({&value}, {}, Measure::plain) == "1 -> not given");
}

TEST_CASE("of two units the one in Hz says what it is in rad/sample, outward") {
  const rigor::UpwardRounding upward;
  const Json hertz = test::hertz("40", 0.031415926535897932385);
  const Json sampled = number("0.02");
  const ContractValue at_8_khz{&hertz, false, Interval(8000.0)};
  CHECK(shown_values(at_8_khz, {&sampled, false, Interval(8000.0)}, Measure::frequency) ==
        "40 Hz = [0.0314159, 0.031416] rad/sample -> 0.02 rad/sample");
  CHECK(shown_values(at_8_khz, at_8_khz, Measure::frequency) == "40 Hz -> 40 Hz");
  const Json band = Json::array({number("100"), number("200")});
  CHECK(shown_values({&band, true}, {&band, true}, Measure::frequency) ==
        "[100 Hz, 200 Hz] -> [100 Hz, 200 Hz]");
}

TEST_CASE("of texts with many lines the first that differs is told") {
  CHECK(shown("a = 1\nb = 2\nc = 3\n", "a = 1\n  b = 4\nc = 5\n") == "line 2: b = 2 -> b = 4");
  CHECK(shown("a = 1\nb = 2\n", "a = 1\n") == "line 2: b = 2 -> nothing");
}

}  // namespace
