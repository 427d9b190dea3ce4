#include "analysis/rigor/larger_or_nan.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace veritrack::rigor {

TEST_CASE("the larger one of two numbers, and none where one of them is none, in either order") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  CHECK(larger_or_nan(1.0, 2.0) == 2.0);
  CHECK(larger_or_nan(2.0, 1.0) == 2.0);
  CHECK(larger_or_nan(-kInfinity, -1.0) == -1.0);
  CHECK(larger_or_nan(1.0, kInfinity) == kInfinity);
  for (const double number : {0.0, 1.0, -kInfinity, kInfinity, kNaN}) {
    CHECK(std::isnan(larger_or_nan(number, kNaN)));
    CHECK(std::isnan(larger_or_nan(kNaN, number)));
  }
  // One that is not a number is not forgotten when a number follows.
  double worst = 0.0;
  for (const double each : {1.0, kNaN, 3.0}) {
    worst = larger_or_nan(worst, each);
  }
  CHECK(std::isnan(worst));
}

}  // namespace veritrack::rigor
