// Numbers of a set of tubes that cannot be any are objected to, when they are read.
#include "checker/model/tube_evidence.hpp"

#include <doctest/doctest.h>

#include <string>

#include "checker/model/model_recursion.hpp"
#include "tests/checker/model/proposed_certificate.hpp"
#include "tests/support/golden.hpp"

namespace veritrack::checker {
namespace {

Objections objections_to_set(const test::Json& set, const test::Json& model) {
  const ModelRecursion recursion(read_json(model.dump()));
  Objections objections;
  (void)read_tube_set(read_json(set.dump()), recursion.states(), objections, recursion.filtered());
  return objections;
}

TEST_CASE("rates of shrinking are above 0, and below 1 where there are levels to come down") {
  const test::Json& certificate = test::loop_certificate();
  const auto objections_to_rate = [&](double rate, bool has_one_level) {
    test::Json set = certificate["tubes"][1];
    for (test::Json& cell : set["cells"]) {
      cell["levels"] = has_one_level ? test::hexadecimals({0.0045}) : test::hexadecimals({0.0045, 0.0022});
      cell["shrinking"] = test::hexadecimals({rate});
    }
    return objections_to_set(set, certificate["design"]["model"]);
  };
  const Objections refusal{"rates of shrinking are for each pair of levels, positive and below 1"};
  CHECK(objections_to_rate(0.5, true).empty());
  CHECK(objections_to_rate(0.5, false).empty());
  CHECK(objections_to_rate(1.0, true).empty());
  CHECK(objections_to_rate(1.0, false) == refusal);
  for (const double rate : {1.001, 0.0, -0.5}) {
    CAPTURE(rate);
    CHECK(objections_to_rate(rate, true) == refusal);
    CHECK(objections_to_rate(rate, false) == refusal);
  }
}

TEST_CASE("bounds of a covariance leave a margin between 0 and 1 where the frequency moves") {
  const auto certificate = test::Json::parse(
      test::read_file(VERITRACK_SOURCE_DIR "/tests/certificates/accepted/model-filter-moving.json"));
  const auto objections_to_margin = [&](double margin) {
    test::Json set = certificate["tubes"][0];
    REQUIRE(set.contains("margin"));
    set["margin"] = test::hexadecimal(margin);
    return objections_to_set(set, certificate["design"]["model"]);
  };
  CHECK(objections_to_margin(0.5).empty());
  for (const double margin : {1.0, 1.5, 0.0, -0.5}) {
    CAPTURE(margin);
    CHECK(objections_to_margin(margin) == Objections{"a margin is between 0 and 1"});
  }
}

}  // namespace
}  // namespace veritrack::checker
