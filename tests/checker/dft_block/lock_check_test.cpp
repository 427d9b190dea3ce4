#include "checker/dft_block/lock_check.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using checker::Ball;

TEST_CASE("the root of the information of a block, times its transpose, is the information") {
  test::Random random(20'261);
  const std::int64_t cases = test::effort(200);
  for (std::int64_t i = 0; i < cases; ++i) {
    checker::MeetingSums sums;
    const double aa = random.uniform(0.2, 2.0);
    const double bb = random.uniform(0.2, 4.0);
    sums.aa = Ball(aa);
    sums.bb = Ball(bb);
    sums.ab = Ball(random.uniform(-0.9, 0.9) * std::sqrt(aa * bb));
    const Ball weight(std::exp(random.uniform(-3.0, 6.0)));
    const Ball x(random.uniform(0.3, 2.0));
    const checker::Matrix3 information = checker::block_information(sums, weight, x);
    const checker::Matrix3 root = checker::root_of_block_information(sums, weight, x);
    checker::Matrix3 again;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        again[row][column] =
            root[row][0] * root[column][0] + root[row][1] * root[column][1] + root[row][2] * root[column][2];
      }
    }
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        const Ball difference = again[row][column] - information[row][column];
        CHECK(difference.lower_double() <= 0.0);
        CHECK(difference.upper_double() >= 0.0);
        CHECK(difference.upper_double() - difference.lower_double() <= 1e-25 * weight.upper_double());
      }
    }
  }
}

TEST_CASE("where the information is not definite it has no root") {
  checker::MeetingSums sums;
  sums.aa = Ball(1.0);
  sums.ab = Ball(2.0);
  sums.bb = Ball(1.0);
  const checker::Matrix3 root = checker::root_of_block_information(sums, Ball(1.0), Ball(1.0));
  CHECK(!checker::certainly_less(checker::abs(root[0][0]), Ball(1e300)));
}

}  // namespace
