#include "papers/dft_block/lock_claims.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/rounding.hpp"

using namespace veritrack;

TEST_CASE("each printed design has starts from which it never finds the tone") {
  const rigor::UpwardRounding upward;
  const auto claims = dft_block::lock_claims();
  REQUIRE(claims.size() == 3);
  for (const theorems::Statement& claim : claims) {
    CAPTURE(claim.id);
    CHECK(claim.verdict == rigor::Verdict::proved);
    CHECK(claim.witness.find("-0.9") != std::string::npos);
  }
}
