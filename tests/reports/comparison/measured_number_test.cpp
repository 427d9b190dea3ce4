#include "reports/comparison/measured_number.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/rounding.hpp"
#include "tests/reports/comparison/values.hpp"

namespace {

using namespace veritrack;           // NOLINT(google-build-using-namespace)
using namespace veritrack::reports;  // NOLINT(google-build-using-namespace)
using certificates::Measure;
using rigor::Interval;
using Json = nlohmann::ordered_json;

// 2 pi 40/8000 to 20 digits.
constexpr double kFortyHertz = 0.031415926535897932385;

bool holds(const std::optional<Interval>& x, double value) {
  return x && x->lower() <= value && value <= x->upper();
}

TEST_CASE("a number is read from its ends, and nothing else is one") {
  CHECK(rigor::identical(*number_in(test::number("0.25")), Interval(0.25)));
  CHECK(rigor::identical(*number_in(test::number("0.10")), *number_in(test::number("0.1"))));
  for (const char* text :
       {R"(3)", R"("0.1")", R"({"text": "1"})", R"({"text": "1", "lo": "0x1p+0"})",
        R"({"text": "1", "lo": "nan", "hi": "0x1p+0"})", R"({"text": "1", "lo": "0x1p+1", "hi": "0x1p+0"})",
        R"({"text": "1", "lo": 1, "hi": 1})"}) {
    INFO(text);
    CHECK_FALSE(number_in(Json::parse(text)));
  }
}

TEST_CASE("a frequency is known in both units where there is a sample rate") {
  const rigor::UpwardRounding upward;
  const ContractValue at_8_khz{nullptr, false, Interval(8000.0)};
  const auto written = measured(test::hertz("40", kFortyHertz), at_8_khz, Measure::frequency);
  REQUIRE(written);
  CHECK(written->written_in_hertz);
  CHECK(rigor::identical(*written->physical, Interval(40.0)));
  CHECK(holds(written->sampled, kFortyHertz));

  const auto sampled = measured(test::number("0.5"), at_8_khz, Measure::frequency);
  CHECK_FALSE(sampled->written_in_hertz);
  CHECK(holds(sampled->physical, 636.61977236758134308));  // 4000/(2 pi)

  const ContractValue flagged{nullptr, true, Interval(8000.0)};
  const auto model = measured(test::number("40"), flagged, Measure::frequency);
  CHECK(model->written_in_hertz);
  CHECK(holds(model->sampled, kFortyHertz));

  CHECK_FALSE(measured(test::number("0.5"), {}, Measure::frequency)->physical);
}

TEST_CASE("a slew has the square of the rate, and samples are seconds") {
  const rigor::UpwardRounding upward;
  const ContractValue at_100_hz{nullptr, false, Interval(100.0)};
  CHECK(holds(measured(test::number("1"), at_100_hz, Measure::slew)->physical,
              1591.5494309189533577));  // 1e4/(2 pi)
  CHECK(holds(measured(test::number("200"), at_100_hz, Measure::samples)->physical, 2.0));
  CHECK_FALSE(measured(test::number("200"), at_100_hz, Measure::plain)->physical);
}

}  // namespace
