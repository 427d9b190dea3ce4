#include "certificates/document/json.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/certificates/test_design.hpp"

// That every certificate fits the schema is tested on the program's own output, by tests/cli/certify_test.py.

namespace {

using namespace veritrack;
using theorems::Sense;

nlohmann::json parsed(const certificates::Certificate& certificate) {
  return nlohmann::json::parse(certificates::to_json(certificate));
}

const nlohmann::json* derivation_of(const nlohmann::json& json, const std::string& id) {
  for (const auto& derivation : json["derivations"]) {
    if (derivation["id"] == id) {
      return &derivation;
    }
  }
  return nullptr;
}

TEST_CASE("hexadecimal endpoints give back what is proved bit by bit, and nothing else is there") {
  const certificates::Certificate certificate = test::certificate();
  const nlohmann::json json = parsed(certificate);
  for (const auto& derivation : certificate.derivations) {
    const nlohmann::json* found = derivation_of(json, derivation.id);
    if (found == nullptr) {
      continue;
    }
    std::size_t proved = 0;
    for (const auto& quantity : derivation.quantities) {
      if (!quantity.applies() || !quantity.is_proved()) {
        continue;
      }
      ++proved;
      const auto& value = (*found)["quantities"][quantity.name];
      CHECK(value.contains("lo") == (quantity.sense != Sense::at_most));
      CHECK(value.contains("hi") == (quantity.sense != Sense::at_least));
      for (const auto& [end, number] : value.items()) {
        CHECK(std::strtod(number.get<std::string>().c_str(), nullptr) ==
              (end == "lo" ? quantity.value.lower() : quantity.value.upper()));
      }
    }
    CHECK((*found)["quantities"].size() == proved);
  }
}

TEST_CASE("what is undecided is not there") {
  const certificates::Certificate certificate = test::certificate({{"q1 = 0.0023", "q1 = 0"}});
  const nlohmann::json json = parsed(certificate);
  CHECK(json.dump().find("undecided") == std::string::npos);
  for (const auto& claim : json["claims"]) {
    CHECK_FALSE(claim.contains("statement"));
  }
  CHECK_FALSE((*derivation_of(json, "theorem-2.9/printed"))["quantities"].contains("q"));
}

TEST_CASE("a name that is not UTF-8 does not break the document") {
  certificates::Design design = test::design();
  design.name = "\xff";
  const auto certificate = certificates::certify(design, "\xff.toml", test::design_text());
  CHECK(nlohmann::json::accept(certificates::to_json(certificate)));
}

}  // namespace
