// What sentences on a regulator say of the noise of its tracker.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "checker/verification.hpp"
#include "tests/support/golden.hpp"

namespace veritrack::checker {
namespace {

std::string guarantee_of_regulator(const nlohmann::json& certificate) {
  const Verification found = verify(read_json(certificate.dump()));
  const auto sentence = std::find_if(found.sentences.begin(), found.sentences.end(),
                                     [](const Sentence& each) { return each.id == "regulator/guarantee"; });
  REQUIRE(sentence != found.sentences.end());
  return sentence->text;
}

}  // namespace

TEST_CASE("a regulator whose tracker is in noise sees its output with that noise") {
  const nlohmann::json certificate = nlohmann::json::parse(
      test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/accepted/regulator.json"));
  const std::string with_noise = " on; it sees y with that noise. For every such tone v";
  CHECK(guarantee_of_regulator(certificate).find(with_noise) != std::string::npos);
}

}  // namespace veritrack::checker
