#include "checker/regulator/inverse_filter.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace veritrack::checker;

TEST_CASE("the inverse of 1 - p q^-1 is a geometric series") {
  for (const double pole : {0.0, 0.5, -0.875}) {
    CAPTURE(pole);
    const InverseFilter inverse({Ball(1.0), Ball(-pole)});
    const Ball rest = one - abs(Ball(pole));
    REQUIRE(inverse.is_stable());
    CHECK(certainly_at_most(one / rest, inverse.norm() + Ball(1e-15)));
    CHECK(certainly_less(inverse.norm(), one / rest + Ball(1e-9)));
    CHECK(certainly_less(inverse.delay_norm(), one / square(rest) + Ball(1e-9)));
    CHECK(certainly_at_most(one / square(rest), inverse.delay_norm() + Ball(1e-15)));
    CHECK(certainly_less(inverse.peak(), Ball(1.0 + 1e-9)));
    CHECK(certainly_less(inverse.tail(2), square(Ball(pole)) / rest + Ball(1e-9)));
    CHECK(certainly_at_most(square(Ball(pole)) / rest, inverse.tail(2) + Ball(1e-15)));
  }
}

TEST_CASE("what is not certainly stable has no bounds") {
  for (const std::vector<Ball>& unstable : {std::vector<Ball>{Ball(1.0), Ball(-1.0)},
                                            {Ball(1.0), Ball(-1.1)},
                                            {Ball(1.0), Ball(0.0), Ball(1.0)},
                                            {Ball(0.0), Ball(1.0)},
                                            {Ball(1.0), Ball::everything()},
                                            {Ball(1.0), Ball::hull(Ball(-1.1), Ball(-0.2))}}) {
    const InverseFilter inverse(unstable);
    CHECK_FALSE(inverse.is_stable());
    CHECK_FALSE(inverse.norm().finite());
    CHECK_FALSE(inverse.tail(0).finite());
    CHECK_FALSE(inverse.peak().finite());
  }
}
