#include "checker/dft_block/dft_block_certificate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
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
