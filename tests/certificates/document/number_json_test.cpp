#include "certificates/document/number_json.hpp"

#include <doctest/doctest.h>

namespace {

using namespace veritrack;

TEST_CASE("a zero as a bound has no sign: intervals kept in other ways give the same bytes") {
  for (const double low : {0.0, -0.0}) {
    for (const double high : {0.0, -0.0}) {
      CHECK(certificates::enclosure_json(rigor::Interval::from_bounds(low, high)).dump() ==
            R"({"lo":"0x0p+0","hi":"0x0p+0"})");
    }
  }
}

TEST_CASE("the bounds of an enclosure keep their signs") {
  CHECK(certificates::enclosure_json(rigor::Interval::from_bounds(-0.5, 3.0)).dump() ==
        R"({"lo":"-0x1p-1","hi":"0x1.8p+1"})");
}

}  // namespace
