// Which designs a recursion may be a part of: the accepted certificate, with its design written in other
// ways.
#include "checker/single_channel/recursion.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "checker/verification.hpp"
#include "tests/support/golden.hpp"

using namespace veritrack;

namespace {

using Json = nlohmann::ordered_json;

Json recursion_certificate() {
  return Json::parse(test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/accepted/recursion.json"));
}

bool is_recursion_verified(const Json& json) {
  return checker::verify(checker::read_json(json.dump())).verified();
}

std::string hexadecimal_of(double value) {
  char text[40];
  (void)std::snprintf(text, sizeof text, "%a", value);
  return text;
}

/// About a decimal, or about what it is in another unit: the checker asks for an enclosure.
Json number_about(const std::string& text, double value) {
  return {{"text", text},
          {"lo", hexadecimal_of(std::nextafter(value, -INFINITY))},
          {"hi", hexadecimal_of(std::nextafter(value, INFINITY))}};
}

/// The tightest one around a decimal that is no double.
Json tightest(const std::string& text) {
  const double nearest = std::stod(text);
  const long double exact = std::stold(text);
  const bool is_above = static_cast<long double>(nearest) > exact;
  return {{"text", text},
          {"lo", hexadecimal_of(is_above ? std::nextafter(nearest, -INFINITY) : nearest)},
          {"hi", hexadecimal_of(is_above ? nearest : std::nextafter(nearest, INFINITY))}};
}

}  // namespace

TEST_CASE("the process noise may be written as two variances") {
  Json json = recursion_certificate();
  Json& chosen = json["design"]["design"];
  const Json q = chosen["q"];
  chosen.erase("q");
  chosen["process_noise"] = {{"q1", q}, {"q2", q}};
  CHECK(is_recursion_verified(json));
  for (const char* one : {"q1", "q2"}) {
    Json other = json;
    other["design"]["design"]["process_noise"][one] = tightest("0.0051");
    CHECK_FALSE(is_recursion_verified(other));
  }
}

TEST_CASE("process noise of the frequency alone is another filter") {
  Json json = recursion_certificate();
  json["design"]["design"]["process_noise"] = "frequency-only";
  CHECK_FALSE(is_recursion_verified(json));
}

TEST_CASE("a ratio of the variances is q = 1 and r, at another scale") {
  Json json = recursion_certificate();
  Json& chosen = json["design"]["design"];
  chosen.erase("q");
  chosen.erase("r");
  chosen["lambda"] = number_about("2", 2.0);
  chosen["lambda"]["lo"] = chosen["lambda"]["hi"] = hexadecimal_of(2.0);
  CHECK_FALSE(is_recursion_verified(json));  // 0.01/0.005, but the recursion has these
}

TEST_CASE("a band in Hz is that of a recursion in Hz") {
  const double turn = 8.0 * std::atan(1.0);
  Json json = recursion_certificate();
  Json& assume = json["design"]["assume"];
  Json& inner = json["recursion"]["design"]["assume"];
  const Json rate = {{"text", "1000"}, {"lo", hexadecimal_of(1000.0)}, {"hi", hexadecimal_of(1000.0)}};
  assume["sample_rate"] = inner["sample_rate"] = rate;
  inner["frequency_in_hertz"] = true;
  std::size_t end = 0;
  for (const char* hertz : {"238.74", "238.88"}) {
    inner["frequency"][end] = tightest(hertz);
    assume["frequency"][end++] = number_about(std::string(hertz) + " Hz", turn * std::stod(hertz) / 1000.0);
  }
  CHECK(is_recursion_verified(json));
  Json other = json;
  other["recursion"]["design"]["assume"]["sample_rate"]["text"] = "1000.0";
  CHECK_FALSE(is_recursion_verified(other));
  other = json;
  other["recursion"]["design"]["assume"]["frequency_in_hertz"] = false;
  CHECK_FALSE(is_recursion_verified(other));
  other = json;
  other["design"]["assume"]["frequency"][1] = tightest("1.501");  // one end in rad/sample
  CHECK_FALSE(is_recursion_verified(other));
}

TEST_CASE("the Jacobian may be written out: it is the same filter") {
  Json json = recursion_certificate();
  Json& jacobian = json["recursion"]["design"]["model"]["ekf"]["jacobian"];
  jacobian = {{"cos(w)", "-sin(w)", "-(sin(w)*x1 + cos(w)*x2)"},
              {"sin(w)", "cos(w)", "cos(w)*x1 - sin(w)*x2"},
              {"0", "0", "1 - epsilon"}};
  CHECK(is_recursion_verified(json));
  jacobian[1][2] = "cos(w)*x1 + sin(w)*x2";
  CHECK_FALSE(is_recursion_verified(json));
}
