// Requirements on a KKL observer follow from a bound that was verified, or not at all.
#include "checker/kkl_observer/kkl_certificate.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "checker/verification.hpp"
#include "tests/support/golden.hpp"

using namespace veritrack;

TEST_CASE("without the derivation nothing that is required is proved") {
  auto certificate = nlohmann::ordered_json::parse(
      test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/accepted/kkl-observer.json"));
  if (certificate.contains("certificate")) {
    certificate = nlohmann::ordered_json(certificate["certificate"]);
  }
  certificate["derivations"] = nlohmann::ordered_json::array();
  for (auto& claim : certificate["claims"]) {
    claim["evidence"] = nlohmann::ordered_json::object();
  }
  const checker::Verification found = verify(checker::read_json(certificate.dump()));
  CHECK_FALSE(found.verified());
  std::size_t refused = 0;
  for (const checker::Part& part : found.parts) {
    refused += part.name.starts_with("claim ") && !part.objections.empty() ? 1U : 0U;
  }
  CHECK(refused == certificate["claims"].size());
  CHECK(refused > 0);
}
