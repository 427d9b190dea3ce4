// The radius that a certificate chose, within which the error equation is bounded.
#include "checker/theorems/error_equation.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace veritrack::checker;

TEST_CASE("a radius is above 0 and at most a half") {
  const auto radius = [](const std::string& value) {
    return claimed_radius(read_json(R"({"quantities": {"radius": {"lo": ")" + value + R"("}}})"), "radius");
  };
  CHECK(certainly_equal(radius("0x1p-1"), half));
  CHECK_FALSE(radius("0x0p+0").finite());
  CHECK_FALSE(radius("-0x1p-2").finite());
  CHECK_FALSE(radius("0x1.1p-1").finite());
  CHECK_FALSE(claimed_radius(read_json(R"({"quantities": {}})"), "radius").finite());
}
