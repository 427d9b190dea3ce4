#include "reports/comparison/certificate_changes.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

namespace {

using veritrack::reports::certificate_changes;
using Kind = veritrack::reports::CertificateChange::Kind;

std::string certificate(const std::string& claims, const std::string& verdict = "proved",
                        const std::string& q1 = "0.1") {
  return R"({"schema": "veritrack/certificate/2", "verdict": ")" + verdict +
         R"(", "design": {"name": "x", "design": {"q1": {"text": ")" + q1 +
         R"(", "lo": "0x0p+0", "hi": "0x0p+0"}}}, "claims": [)" + claims + "]}";
}

std::string claim(const std::string& id, const std::string& evidence, const std::string& more = "",
                  const std::string& verdict = "proved") {
  return R"({"id": ")" + id + R"(", "verdict": ")" + verdict + R"(", "required": false, "evidence": {)" +
         evidence + "}" + more + "}";
}

TEST_CASE("a bound from above is better when it is less, one from below when it is more") {
  const auto upper = [](const char* value) {
    return certificate(claim("ekf/guarantee", std::string(R"("unknown_bound": {"hi": ")") + value + "\"}"));
  };
  const auto lower = [](const char* value) {
    return certificate(claim("ekf/limits", std::string(R"("unknown_size": {"lo": ")") + value + "\"}"));
  };
  CHECK(certificate_changes(upper("0x1p+0"), upper("0x1p-1"), 0.001).at(0).kind == Kind::better);
  CHECK(certificate_changes(upper("0x1p-1"), upper("0x1p+0"), 0.001).at(0).kind == Kind::worse);
  CHECK(certificate_changes(lower("0x1p-1"), lower("0x1p+0"), 0.001).at(0).kind == Kind::better);
  CHECK(certificate_changes(lower("0x1p+0"), lower("0x1p-1"), 0.001).at(0).kind == Kind::worse);
  CHECK(certificate_changes(lower("0x1p+0"), lower("0x1p+0"), 0.0).empty());
}

TEST_CASE("what is not a number is worse") {
  const auto upper = [](const char* value) {
    return certificate(claim("ekf/guarantee", std::string(R"("bound": {"hi": ")") + value + "\"}"));
  };
  CHECK(certificate_changes(upper("0x1p+0"), upper("nan"), 0.001).at(0).kind == Kind::worse);
}

TEST_CASE("decimals of a model's claims: noise and reach, the bias by its larger end") {
  const auto limits = [](const char* noise, const char* low) {
    return certificate(claim("model/limits", "", std::string(R"(, "noise": ")") + noise + "\"") + "," +
                       claim("model/steady-state", "",
                             std::string(R"(, "bias_low": ")") + low + R"(", "bias_high": "1e-7")"));
  };
  const auto changes = certificate_changes(limits("0.02", "-1e-6"), limits("0.03", "-2e-6"), 0.001);
  REQUIRE(changes.size() == 2);
  CHECK(changes[0].kind == Kind::worse);
  CHECK(changes[0].text == "mean frequency error in the long run, at most: 1e-06 -> 2e-06 rad/sample");
  CHECK(changes[1].kind == Kind::better);
}

TEST_CASE("a guarantee that is gone is worse; a published theorem's condition is told") {
  const std::string both = certificate(claim("ekf/guarantee", "") + "," + claim("lemma-3.1/conditions", ""));
  const auto changes = certificate_changes(both, certificate("", "undecided"), 0.001);
  REQUIRE(changes.size() == 3);
  CHECK(changes[0].text == "what is required: proved -> undecided");
  CHECK(changes[0].kind == Kind::worse);
  CHECK(changes[1].text == "ekf/guarantee: proved -> not said");
  CHECK(changes[1].kind == Kind::worse);
  CHECK(changes[2].kind == Kind::other);
}

TEST_CASE("bounds of what is not proved are nothing") {
  const auto refuted = certificate(claim("ekf/guarantee", R"("b": {"hi": "0x1p+0"})", "", "refuted"));
  const auto proved = certificate(claim("ekf/guarantee", R"("b": {"hi": "0x1p+4"})"));
  const auto changes = certificate_changes(refuted, proved, 0.001);
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].kind == Kind::better);
}

TEST_CASE("another design is told with what is written") {
  const auto changes =
      certificate_changes(certificate("", "proved", "0.1"), certificate("", "proved", "0.2"), 0.001);
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].text == "design.q1: 0.1 -> 0.2");
  CHECK(changes[0].kind == Kind::other);
}

TEST_CASE("what is no certificate is refused") {
  for (const char* text : {"", "{}", "[]", R"({"schema": "veritrack/certificate/1"})",
                           R"({"schema": "veritrack/certificate/2"})"}) {
    CHECK_THROWS_AS((void)certificate_changes(text, certificate(""), 0.001), std::invalid_argument);
  }
}

}  // namespace
