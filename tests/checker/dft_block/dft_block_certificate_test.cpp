#include "checker/dft_block/dft_block_certificate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "checker/verification.hpp"
#include "tests/support/golden.hpp"

using namespace veritrack::checker;

namespace {

std::string guarantee_of(const std::string& name) {
  const Verification found = verify(
      read_json(veritrack::test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/accepted/" + name)));
  REQUIRE(found.verified());
  const auto sentence = std::find_if(found.sentences.begin(), found.sentences.end(),
                                     [](const Sentence& one) { return one.id == "dft-block/guarantee"; });
  REQUIRE(sentence != found.sentences.end());
  CHECK(sentence->text.starts_with(sentence->hypotheses));
  return sentence->text.substr(sentence->hypotheses.size());
}

}  // namespace

TEST_CASE("an offset error once settled is named where it is less than that of every block") {
  // 0.00999 bins once settled, by this certificate, which says nothing beside 0.00751 bins in every block.
  CHECK(guarantee_of("dft-block.json") ==
        "the offset error of every estimate and prediction is at most 0.00751 bins, and in the long run at "
        "most 0.00118 bins.");
}

TEST_CASE(
    "a requirement on when errors settle is proved from that block on, below that error, and no sooner") {
  const auto verdict = [](const char* key, const char* text, const char* value) {
    auto certificate = nlohmann::json::parse(
        veritrack::test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/accepted/dft-block.json"));
    certificate["design"]["require"][key] = {{"text", text}, {"lo", value}, {"hi", value}};
    return verify(read_json(certificate.dump())).verified();
  };
  // The certificate says that from block 1 on the offset error is at most 0.0099899 bins.
  CHECK(verdict("settles_within", "1", "0x1p+0"));
  CHECK_FALSE(verdict("settles_within", "0.75", "0x1.8p-1"));
  CHECK(verdict("settled_below", "0.01171875", "0x1.8p-7"));
  CHECK_FALSE(verdict("settled_below", "0.0078125", "0x1p-7"));
}
