#include "certificates/document/json.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/certificates/test_design.hpp"

// That every certificate fits the schema is tested on the program's own output, by tests/cli/certify_test.py.

namespace {

using namespace veritrack;

TEST_CASE("hexadecimal endpoints give back the enclosure bit by bit") {
  const certificates::Certificate certificate = test::certificate();
  const nlohmann::json json = nlohmann::json::parse(certificates::to_json(certificate));
  REQUIRE(json["derivations"].size() == certificate.derivations.size());
  for (std::size_t i = 0; i < certificate.derivations.size(); ++i) {
    for (const auto& quantity : certificate.derivations[i].quantities) {
      if (quantity.not_applicable) {
        continue;
      }
      const auto& found = json["derivations"][i]["quantities"][quantity.name];
      CHECK(std::strtod(found["lo"].get<std::string>().c_str(), nullptr) == quantity.value.lower());
      CHECK(std::strtod(found["hi"].get<std::string>().c_str(), nullptr) == quantity.value.upper());
    }
  }
}

TEST_CASE("what does not exist is listed apart, with its reason") {
  const auto json =
      nlohmann::json::parse(certificates::to_json(test::certificate({{"q1 = 0.0023", "q1 = 0"}})));
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& derivation = json["derivations"][i];
    CHECK_FALSE(derivation["quantities"].contains("q"));
    CHECK_FALSE(derivation["not_applicable"]["q"]["reason"].get<std::string>().empty());
  }
}

TEST_CASE("a file name that is not UTF-8 does not break the document") {
  const auto certificate = certificates::certify(test::design(), "\xff.toml", test::design_text());
  CHECK(nlohmann::json::accept(certificates::to_json(certificate)));
}

}  // namespace
