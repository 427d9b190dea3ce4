#include "checker/numbers/decimal_text.hpp"

#include <doctest/doctest.h>

#include "checker/numbers/ball.hpp"

using namespace veritrack::checker;

TEST_CASE("decimals in sentences are rounded in the direction in which they are true") {
  CHECK(upper_decimal(Ball(0.0055513)) == "0.00556");
  CHECK(lower_decimal(Ball(0.0055513)) == "0.00555");
  CHECK(upper_decimal(Ball(-0.0055513)) == "-0.00555");
  CHECK(lower_decimal(Ball(-0.0055513)) == "-0.00556");
  CHECK(upper_decimal(Ball(0.0)) == "0");
  CHECK(upper_decimal(Ball(200.0)) == "200");
  CHECK(upper_decimal(Ball(1234.0)) == "1240");
  CHECK(upper_decimal(Ball(999.5)) == "1000");
  CHECK(upper_decimal(Ball(12.34)) == "12.4");
  CHECK(upper_decimal(Ball(1e-5)) == "0.0000101");  // the double is above the decimal
  CHECK(upper_decimal(Ball(0x1p-20)) == "9.54e-7");
  CHECK(lower_decimal(Ball(1e10)) == "1e10");
  CHECK(upper_decimal(Ball::hull(Ball(1.1), Ball(2.0001))) == "2.01");
  CHECK(lower_decimal(Ball::hull(Ball(1.105), Ball(2.0001))) == "1.1");
  CHECK(upper_decimal(Ball::everything()) == "inf");
  CHECK(lower_decimal(Ball::everything()) == "-inf");
}
