// The two inequalities of a step about the steady state, each broken in one of its parts.
#include "checker/quadrature/steady_rate.hpp"

#include <doctest/doctest.h>

using namespace veritrack::checker;

namespace {

Row<Ball> row_of_zeros() {
  Row<Ball> row;
  row.fill(zero);
  return row;
}

const Ball kLimit(0.81);
const Multipliers kMultipliers{0.5, 0.25};

}  // namespace

TEST_CASE("a step contracts only when every part of it fits together with the others") {
  Row<Ball> row = row_of_zeros();
  row[0] = Ball(0.5);
  row[kSlope] = Ball(0.25);
  row[kGram] = Ball(0.125);
  row[kEta] = Ball(0.25);
  // 0.5^2/(0.81 - 0.25 - 0.125) + 0.25^2/0.25 + 0.125/0.5 = 1.07: too much, and 0.82 with a smaller constant.
  CHECK(!contracts(row, kLimit, kMultipliers));
  row[0] = Ball(0.375);
  CHECK(contracts(row, kLimit, kMultipliers));
  SUBCASE("a constant off the first axis") {
    row[2] = Ball(0.75);
  }
  SUBCASE("a slope") {
    row[kSlope + 4] = Ball(0.75);
  }
  SUBCASE("a spread") {
    row[kGram + 5] = Ball(0.75);
  }
  SUBCASE("more of eta") {
    row[kEta] = Ball(1.0);
  }
  CHECK(!contracts(row, kLimit, kMultipliers));
}

TEST_CASE("multipliers that are not positive prove nothing") {
  const Row<Ball> row = row_of_zeros();
  CHECK(contracts(row, kLimit, kMultipliers));
  CHECK(!contracts(row, kLimit, {-0.5, 0.25}));
  CHECK(!contracts(row, kLimit, {0.5, -0.25}));
  CHECK(!contracts(row, kLimit, {0.5, 1.0}));  // nothing is left of the rate
}

TEST_CASE("the covariance is kept on both sides, and so far as it may turn either way") {
  SteadySetting setting;
  setting.below = {Ball(1.0), zero, zero, Ball(1.0), zero, Ball(1.0)};
  setting.above = {Ball(2.0), zero, zero, Ball(2.0), zero, Ball(2.0)};
  Row<Ball> row = row_of_zeros();
  for (const std::size_t k : {0U, 3U, 5U}) {
    row[kLow + k] = Ball(-0.5);
    row[kHigh + k] = Ball(1.5);
  }
  const Symmetric<Ball> none{zero, zero, zero, zero, zero, zero};
  const Symmetric<Ball> little{Ball(0.125), zero, zero, Ball(-0.125), Ball(0.125), zero};
  CHECK(keeps_covariance(row, {little, little}, setting, one));
  CHECK(!keeps_covariance(row, {none, none}, setting, Ball(0.7)));  // not below 1.4 above
  CHECK(!keeps_covariance(row, {none, none}, setting, Ball(0.4)));
  CHECK(!keeps_covariance(row, {none, none}, setting, Ball(-1.0)));
  for (const double sign : {-1.0, 1.0}) {
    const Symmetric<Ball> far{Ball(0.75 * sign), zero, zero, zero, zero, zero};
    CHECK(!keeps_covariance(row, {far, none}, setting, one));
    CHECK(!keeps_covariance(row, {none, far}, setting, one));
  }
  Row<Ball> lower = row;
  lower[kLow + 3] = Ball(-1.25);
  CHECK(!keeps_covariance(lower, {none, none}, setting, one));
  Row<Ball> higher = row;
  higher[kHigh + 5] = Ball(2.25);
  CHECK(!keeps_covariance(higher, {none, none}, setting, one));
}
