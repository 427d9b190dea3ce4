#include "reports/comparison/certificate_changes.hpp"

#include <doctest/doctest.h>

#include <array>
#include <stdexcept>
#include <string>

namespace {

using veritrack::reports::CertificateChange;
using veritrack::reports::CertificateChanges;
using veritrack::reports::NothingToAccept;
using Kind = veritrack::reports::CertificateChange::Kind;

std::string certificate(const std::string& claims, const std::string& verdict = "proved",
                        const std::string& q1 = "0.1", const std::string& noise = "0x1p-5") {
  const std::string ends = q1 == "0.1" ? "0x1p-4" : "0x1p-3";
  return R"({"schema": "veritrack/certificate/2", "verdict": ")" + verdict +
         R"(", "design": {"name": "x", "tracker": "quadrature-ekf", "design": {"q1": {"text": ")" + q1 +
         R"(", "lo": ")" + ends + R"(", "hi": ")" + ends + R"("}}, "assume": {"noise": {"text": ")" + noise +
         R"(", "lo": ")" + noise + R"(", "hi": ")" + noise + R"("}}}, "claims": [)" + claims + "]}";
}

std::vector<CertificateChange> changes_between(const std::string& before, const std::string& after,
                                               double tolerance) {
  return veritrack::reports::certificate_changes(before, after, tolerance).list;
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
  CHECK(changes_between(upper("0x1p+0"), upper("0x1p-1"), 0.001).at(0).kind == Kind::better);
  CHECK(changes_between(upper("0x1p-1"), upper("0x1p+0"), 0.001).at(0).kind == Kind::worse);
  CHECK(changes_between(lower("0x1p-1"), lower("0x1p+0"), 0.001).at(0).kind == Kind::better);
  CHECK(changes_between(lower("0x1p+0"), lower("0x1p-1"), 0.001).at(0).kind == Kind::worse);
  CHECK(changes_between(lower("0x1p+0"), lower("0x1p+0"), 0.0).empty());
}

TEST_CASE("the same bound of another claim says whose it is, and is told once where it is the same") {
  const auto both = [](const char* guarantee, const char* limits) {
    return certificate(claim("ekf/guarantee", std::string(R"("bound": {"hi": ")") + guarantee + "\"}") + "," +
                       claim("ekf/limits", std::string(R"("bound": {"hi": ")") + limits + "\"}"));
  };
  const auto changes = changes_between(both("0x1p+0", "0x1p+0"), both("0x1p-1", "0x1p+1"), 0.001);
  REQUIRE(changes.size() == 2);
  CHECK(changes[0].text == "bound: 1 -> 0.5");
  CHECK(changes[1].text == "bound of ekf/limits: 1 -> 2");
  CHECK(changes_between(both("0x1p+0", "0x1p+0"), both("0x1p-1", "0x1p-1"), 0.001).size() == 1);
}

TEST_CASE("what is not a number is worse, from above and from below") {
  for (const char* end : {"hi", "lo"}) {
    const auto bound = [&](const char* value) {
      return certificate(
          claim("ekf/guarantee", std::string(R"("bound": {")") + end + R"(": ")" + value + "\"}"));
    };
    CHECK(changes_between(bound("0x1p+0"), bound("nan"), 0.001).at(0).kind == Kind::worse);
  }
}

TEST_CASE("a bound that is no longer said is worse, and its decimals are rounded outward") {
  const auto both = certificate(claim("ekf/guarantee", R"("b": {"hi": "0x1.999999999999ap-4"})"));
  const auto changes = changes_between(both, certificate(claim("ekf/guarantee", "")), 0.001);
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].kind == Kind::worse);
  CHECK(changes[0].text == "b: 0.1001 -> not said");
  const auto close = certificate(claim("ekf/guarantee", R"("b": {"hi": "0x1.999999999999bp-4"})"));
  CHECK(changes_between(both, close, 0.0).at(0).text == "b: 0.10000000000000001 -> 0.10000000000000002");
}

TEST_CASE("what is better for an easier question does not count, and says what is easier") {
  const auto at = [](const char* noise, const char* bound) {
    return certificate(
        claim("ekf/guarantee", std::string(R"("frequency_error_bound": {"hi": ")") + bound + "\"}"), "proved",
        "0.1", noise);
  };
  const CertificateChanges easier =
      veritrack::reports::certificate_changes(at("0x1p-5", "0x1p-1"), at("0x1p-6", "0x1p-2"), 0.001);
  REQUIRE(easier.list.size() == 2);
  CHECK(easier.list[0].kind == Kind::worse);
  CHECK(easier.list[0].text == "assume.noise: 0x1p-5 -> 0x1p-6 (covers less)");
  CHECK(easier.list[1].kind == Kind::easier);
  REQUIRE(easier.loosened.size() == 1);
  CHECK(easier.loosened[0] == "assume.noise covers less");
  CHECK(easier.count(Kind::better) == 0);
  const auto harder = changes_between(at("0x1p-6", "0x1p-1"), at("0x1p-5", "0x1p-2"), 0.001);
  REQUIRE(harder.size() == 2);
  CHECK(harder[0].kind == Kind::better);
  CHECK(harder[1].kind == Kind::better);
}

TEST_CASE("a change for the worse is accepted by its key, and nothing else is") {
  const std::string before = certificate("", "proved", "0.1", "0x1p-5");
  const std::string after = certificate("", "proved", "0.2", "0x1p-6");
  using Keys = std::array<std::string, 1>;
  const auto accepted = veritrack::reports::certificate_changes(before, after, 0.001, Keys{"assume.noise"});
  CHECK(accepted.count(Kind::accepted) == 1);
  CHECK(accepted.count(Kind::worse) == 0);
  for (const char* key : {"assume.slew", "design.q1", "assume", "", "noise"}) {
    INFO(key);
    CHECK_THROWS_AS((void)veritrack::reports::certificate_changes(before, after, 0.001, Keys{key}),
                    NothingToAccept);
  }
  CHECK_THROWS_WITH(
      (void)veritrack::reports::certificate_changes(before, before, 0.001, Keys{"assume.noise"}),
      "assume.noise is the key of nothing that is worse; allowed: no --accept, since nothing is worse");
}

TEST_CASE("a bound and a claim are accepted by their names, what is required never is") {
  const auto proved = certificate(claim("ekf/guarantee", R"("b": {"hi": "0x1p+0"})"));
  const auto larger = certificate(claim("ekf/guarantee", R"("b": {"hi": "0x1p+1"})"));
  using Keys = std::array<std::string, 1>;
  CHECK(veritrack::reports::certificate_changes(proved, larger, 0.001, Keys{"b"}).count(Kind::worse) == 0);
  const auto gone = certificate("", "undecided");
  const auto changes = veritrack::reports::certificate_changes(proved, gone, 0.001, Keys{"ekf/guarantee"});
  CHECK(changes.count(Kind::accepted) == 1);
  CHECK(changes.count(Kind::worse) == 1);
}

TEST_CASE("decimals of a model's claims: noise and reach, the bias by its larger end") {
  const auto limits = [](const char* noise, const char* low) {
    return certificate(claim("model/limits", "", std::string(R"(, "noise": ")") + noise + "\"") + "," +
                       claim("model/steady-state", "",
                             std::string(R"(, "bias_low": ")") + low + R"(", "bias_high": "1e-7")"));
  };
  const auto changes = changes_between(limits("0.02", "-1e-6"), limits("0.03", "-2e-6"), 0.001);
  REQUIRE(changes.size() == 2);
  CHECK(changes[0].kind == Kind::better);
  CHECK(changes[0].text == "tolerated noise, signal units: 0.02 -> 0.03 (noise)");
  CHECK(changes[1].kind == Kind::worse);
  CHECK(changes[1].text == "mean frequency error in the long run, at most: 1e-6 -> 2e-6 rad/sample (bias)");
}

TEST_CASE("a guarantee that is gone is worse; a published theorem's condition is told") {
  const std::string both = certificate(claim("ekf/guarantee", "") + "," + claim("lemma-3.1/conditions", ""));
  const auto changes = changes_between(both, certificate("", "undecided"), 0.001);
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
  const auto changes = changes_between(refuted, proved, 0.001);
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].kind == Kind::better);
}

TEST_CASE("another design is told with what is written") {
  const auto changes =
      changes_between(certificate("", "proved", "0.1"), certificate("", "proved", "0.2"), 0.001);
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].text == "design.q1: 0.1 -> 0.2");
  CHECK(changes[0].kind == Kind::other);
}

TEST_CASE("what is no certificate is refused") {
  for (const char* text : {"", "{}", "[]", R"({"schema": "veritrack/certificate/1"})",
                           R"({"schema": "veritrack/certificate/2"})"}) {
    CHECK_THROWS_AS((void)changes_between(text, certificate(""), 0.001), std::invalid_argument);
  }
}

}  // namespace
