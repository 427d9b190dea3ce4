#include "certificates/document/report_json.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/certificates/test_design.hpp"

namespace {

using namespace veritrack;

TEST_CASE("what does not exist is listed apart, with its reason") {
  const auto json =
      nlohmann::json::parse(certificates::to_report_json(test::certificate({{"q1 = 0.0023", "q1 = 0"}})));
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& derivation = json["derivations"][i];
    CHECK_FALSE(derivation["quantities"].contains("q"));
    CHECK_FALSE(derivation["not_applicable"]["q"]["reason"].get<std::string>().empty());
  }
}

TEST_CASE("what is sampled is marked, and every claim has its sentence and its verdict") {
  const certificates::Certificate certificate = test::certificate();
  const auto json = nlohmann::json::parse(certificates::to_report_json(certificate));
  REQUIRE(json["claims"].size() == certificate.claims.size());
  for (std::size_t i = 0; i < certificate.claims.size(); ++i) {
    CHECK(json["claims"][i]["statement"] == certificate.claims[i].statement);
  }
  for (std::size_t i = 0; i < certificate.derivations.size(); ++i) {
    for (const auto& quantity : certificate.derivations[i].quantities) {
      if (quantity.applies()) {
        const auto& told = json["derivations"][i]["quantities"][quantity.name];
        CHECK(told.value("proved", true) == quantity.is_proved());
      }
    }
  }
}

TEST_CASE("a file name that is not UTF-8 does not break the document") {
  const auto certificate = certificates::certify(test::design(), "\xff.toml", test::design_text());
  CHECK(nlohmann::json::accept(certificates::to_report_json(certificate)));
}

}  // namespace
