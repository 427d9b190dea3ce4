#include "checker/document/design_number.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "checker/numbers/ball.hpp"

using namespace veritrack::checker;

namespace {

Tree number(const std::string& text, const std::string& low, const std::string& high) {
  return read_json(R"({"text": ")" + text + R"(", "lo": ")" + low + R"(", "hi": ")" + high + R"("})");
}

bool accepted(const std::string& text, const std::string& low, const std::string& high) {
  Objections objections;
  read_number(number(text, low, high), objections);
  return objections.empty();
}

bool band_is_accepted(const std::string& low, const std::string& high) {
  Objections objections;
  read_band(read_json("{\"frequency\":[" + low + "," + high + "]}"), objections);
  return objections.empty();
}

const std::string kQuarter = R"({"text": "0.25", "lo": "0x1p-2", "hi": "0x1p-2"})";
const std::string kThree = R"({"text": "3", "lo": "0x1.8p+1", "hi": "0x1.8p+1"})";
const std::string kFour = R"({"text": "4", "lo": "0x1p+2", "hi": "0x1p+2"})";
const std::string kMinus = R"({"text": "-1", "lo": "-0x1p+0", "hi": "-0x1p+0"})";

}  // namespace

TEST_CASE("[lo, hi] is the tightest enclosure of the decimal, and no other") {
  CHECK(accepted("0.001", "0x1.0624dd2f1a9fbp-10", "0x1.0624dd2f1a9fcp-10"));
  CHECK(accepted("1.0", "0x1p+0", "0x1p+0"));
  CHECK(accepted("0.0", "0x0p+0", "0x0p+0"));
  CHECK_FALSE(accepted("0.001", "0x1.0624dd2f1a9fap-10", "0x1.0624dd2f1a9fcp-10"));
  CHECK_FALSE(accepted("0.001", "0x1.0624dd2f1a9fbp-10", "0x1.0624dd2f1a9fdp-10"));
  CHECK_FALSE(accepted("0.001", "0x1.0624dd2f1a9fcp-10", "0x1.0624dd2f1a9fcp-10"));
  CHECK_FALSE(accepted("1.0", "0x0p+0", "0x1p+10"));
  CHECK_FALSE(accepted("1.0", "0x1p+0", "0x1.0000000000001p+0"));
}

TEST_CASE("a number stands for the decimal and for the double nearest to it, and for nothing beyond them") {
  Objections objections;
  const Ball value =
      read_number(number("0.001", "0x1.0624dd2f1a9fbp-10", "0x1.0624dd2f1a9fcp-10"), objections);
  CHECK(certainly_at_most(value.lower(), from_decimal("0.001").lower()));
  CHECK(certainly_at_most(Ball(0.001), value.upper()));
  CHECK(certainly_at_most(value.upper(),
                          Ball(0x1.0624dd2f1a9fcp-10)));  // 0.001 in double precision is the upper end
  CHECK(certainly_less(Ball(0x1.0624dd2f1a9fbp-10), value.lower()));
}

TEST_CASE("a decimal above the double nearest to it is in its number, too") {
  Objections objections;
  const Ball value = read_number(number("0.3", "0x1.3333333333333p-2", "0x1.3333333333334p-2"), objections);
  CHECK(objections.empty());
  CHECK(certainly_at_most(from_decimal("0.3").upper(), value.upper()));
  CHECK(certainly_equal(Ball(0x1.3333333333333p-2), value.lower()));
}

TEST_CASE("a decimal in the middle of two doubles stands for both, whichever is read") {
  Objections objections;
  const Ball value = read_number(number("9007199254740993", "0x1p+53", "0x1.0000000000001p+53"), objections);
  CHECK(objections.empty());
  CHECK(certainly_at_most(value.lower(), Ball(0x1p+53)));
  CHECK(certainly_at_most(Ball(0x1.0000000000001p+53), value.upper()));
}

TEST_CASE("what is no decimal is malformed") {
  for (const char* text : {"", "nan", "inf", "1e400", "0x1p3", "1,5", " 1"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(accepted(text, "0x1p+0", "0x1p+0"), std::invalid_argument);
  }
  CHECK_THROWS_AS(accepted(std::string(201, '1'), "0x1p+0", "0x1p+0"), std::invalid_argument);
}

TEST_CASE("a band goes from low to high, from 0 to pi, and is never empty") {
  CHECK(band_is_accepted(kQuarter, kThree));
  CHECK(band_is_accepted(kThree, kThree));
  CHECK_FALSE(band_is_accepted(kThree, kQuarter));
  CHECK_FALSE(band_is_accepted(kQuarter, kFour));
  CHECK_FALSE(band_is_accepted(kMinus, kThree));
}

TEST_CASE("the ends of a band are in the same unit") {
  const std::string hertz =
      R"({"text": "1200 Hz", "lo": "0x1.e28c731eb694fp-1", "hi": "0x1.e28c731eb6952p-1"})";
  const std::string rate = R"("sample_rate": {"text": "8000", "lo": "0x1.f4p+12", "hi": "0x1.f4p+12"})";
  const auto objections_to = [&](const std::string& low) {
    Objections objections;
    read_band(read_json("{\"frequency\": [" + low + ", " + hertz + "], " + rate + "}"), objections);
    return objections;
  };
  CHECK(objections_to(hertz).empty());
  CHECK(objections_to(kQuarter) == Objections{"the ends of a band are in the same unit"});
}

TEST_CASE("signs are demanded") {
  Objections objections;
  read_positive(read_json(kQuarter), "a", objections);
  read_not_negative(number("0", "0x0p+0", "0x0p+0"), "b", objections);
  CHECK(objections.empty());
  read_positive(number("0", "0x0p+0", "0x0p+0"), "c", objections);
  read_not_negative(read_json(kMinus), "d", objections);
  CHECK(objections.size() == 2);
}
