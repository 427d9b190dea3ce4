// A start that is known exactly: what the checker verifies of it. What it must not verify is in
// tests/certificates/rejected/model-start-*.json.
#include "checker/model/start_capture.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "checker/verification.hpp"
#include "tests/support/golden.hpp"

namespace veritrack::checker {
namespace {

using Json = nlohmann::json;

/// From rest, in 48 samples.
const Json& certificate() {
  static const Json json = Json::parse(test::read_file(std::string(VERITRACK_SOURCE_DIR) +
                                                       "/tests/certificates/accepted/model-from-rest.json"));
  return json;
}

/// With the claim changed.
Verification verify_claim(const std::function<void(Json& claim)>& change) {
  Json json = certificate();
  change(json["claims"][1]);
  return verify(read_json(json.dump()));
}

bool verifies(const std::function<void(Json& claim)>& change) {
  return verify_claim(change).verified();
}

TEST_CASE("a start from rest is verified, in these words") {
  const Verification found = verify_claim([](Json&) {});
  REQUIRE(found.verified());
  CHECK(found.requirements_proved);
  REQUIRE(found.sentences.size() == 3);
  CHECK(
      found.sentences[2].text.ends_with(" at any phase of the signal, the tracker is in the set \"assumed\" "
                                        "of the certificate after at most 60 samples, and there the "
                                        "frequency error stays at or below 0.01844 rad/sample."));
  CHECK(
      found.sentences[1].text ==
      "In exact arithmetic, on a tone of amplitude 1 with any constant frequency in [0.31, 0.315] "
      "rad/sample, with noise below 0.01, started exactly in {alpha: 0, beta: 0, w: 2*sin(nominal/2)} at any "
      "phase of the signal, the tracker is in the set \"assumed\" of the certificate after at most 48 "
      "samples, with a frequency error of at most 0.0394 rad/sample until then, and the frequency error "
      "stays at or below 0.01844 rad/sample for ever after.");
  const Verification shorter = verify_claim([](Json& claim) { claim.erase("frequency_error_before"); });
  REQUIRE(shorter.verified());
  CHECK(shorter.sentences[1].text.find("after at most 48 samples, and the frequency error stays") !=
        std::string::npos);
}

TEST_CASE("nothing rests on the first grid, and more samples are true, too") {
  const auto with_grid = [](const char* phases, const char* frequencies) {
    return verifies([&](Json& claim) {
      claim["phases"] = phases;
      claim["frequencies"] = frequencies;
    });
  };
  CHECK(with_grid("1", "1"));
  CHECK(with_grid("4", "2"));
  CHECK(with_grid("32", "1"));
  CHECK_FALSE(with_grid("-1", "1"));
  CHECK_FALSE(with_grid("0", "0"));
  CHECK(verifies([](Json& claim) { claim["samples"] = "1e3"; }));
  CHECK(verifies([](Json& claim) { claim["samples"] = "48.0"; }));
  CHECK_FALSE(verifies([](Json& claim) { claim["samples"] = "-48"; }));
  CHECK_FALSE(verifies([](Json& claim) { claim["samples"] = "1e9"; }));
}

TEST_CASE("the least number of samples is not below what simulations need" * doctest::test_suite("nightly")) {
  // They are outside the set until sample 29 and later in the worst case (tests/analysis/model).
  std::size_t least = 48;
  while (least > 4 && verifies([&](Json& claim) { claim["samples"] = std::to_string(least - 2); })) {
    least -= 2;
  }
  MESSAGE("verified in " << least << " samples");
  CHECK(least > 26);
  CHECK(least < 48);
}

TEST_CASE("without a verified set nothing is captured") {
  for (const bool is_empty : {true, false}) {
    Json json = certificate();
    if (is_empty) {
      json["tubes"] = Json::array();
    } else {
      json["tubes"][0]["name"] = "noise";  // verified, and not the one that counts
    }
    json["claims"].erase(0);
    const Verification found = verify(read_json(json.dump()));
    CHECK_FALSE(found.verified());
  }
}

}  // namespace
}  // namespace veritrack::checker
