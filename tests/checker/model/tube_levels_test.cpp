// Levels that are far apart: what is cut off of a polynomial over the large ball is more than the small one
// has room for.
#include <doctest/doctest.h>

#include <string>

#include "checker/verification.hpp"
#include "tests/checker/model/proposed_certificate.hpp"

namespace veritrack::checker {
namespace {

/// x' = step, whatever the samples are, from |x| <= high to |x| <= low: shrinks by the rate in each sample?
bool shrinks_by(double rate, const std::string& step, double high, double low) {
  test::Json json = test::loop_certificate();
  json["design"]["model"].update({{"parameters", test::Json::array()},
                                  {"states", {"x"}},
                                  {"angles", test::Json::array()},
                                  {"step", "x' = " + step},
                                  {"frequency", "0.3 + x"}});
  const test::Json one = test::Json::array({test::hexadecimal(1.0), test::hexadecimal(0.0)});
  const test::Json shape = test::Json::array({test::Json::array({test::Json::array({one})})});
  test::Json cell = json["tubes"][0]["cells"][0];
  cell.update({{"levels", test::hexadecimals({high, low})},
               {"shrinking", test::hexadecimals({rate})},
               {"turns", {0}},
               {"curve", test::Json::array({test::Json::array()})},
               {"shape", shape}});
  json["tubes"] = test::Json::array({test::ProposedModel::set("starts", 0.0, test::Json::array({cell}))});
  json["claims"] = test::Json::array();
  return verify(read_json(json.dump())).verified();
}

TEST_CASE("terms of high degree do not count near the curve") {
  // |x'| <= (1/2 + |x|^3) |x|, and x^4 is cut off.
  CHECK(shrinks_by(0.9, "x/2 + x^4", 0.5, 0.25));
  CHECK(shrinks_by(0.9, "x/2 + x^4", 0.5, 0.0625));
  CHECK(shrinks_by(0.635, "x/2 + x^4", 0.5, 0.45));
  CHECK_FALSE(shrinks_by(0.62, "x/2 + x^4", 0.5, 0.45));
  CHECK_FALSE(shrinks_by(0.62, "x/2 + x^4", 0.5, 0.0625));
  CHECK_FALSE(shrinks_by(0.49, "x/2 + x^4", 0.125, 0.0625));
  // It is the small x that grow, or those in between.
  CHECK_FALSE(shrinks_by(0.9, "0.95*x - x^4", 0.5, 0.0625));
  CHECK_FALSE(shrinks_by(0.9, "x + 2*x^3 - 6*x^4", 0.5, 0.0625));
}

}  // namespace
}  // namespace veritrack::checker
