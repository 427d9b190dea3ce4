#include "checker/quadrature/lock_cover.hpp"

#include <doctest/doctest.h>

#include "tests/checker/quadrature/lock_support.hpp"

using namespace veritrack;
using namespace veritrack::checker;

TEST_CASE("the work of all threads is counted, and ends at the budget") {
  const LockSet set = lock_test::WrittenSet().set();
  const LockFilter filter = lock_test::Variances().filter();
  std::int64_t cells = 0;
  set_budget(kDefaultBudget);
  CHECK(drifts_slowly(filter, set, cells));
  const std::int64_t all = operations_spent();
  CHECK(all > 1000 * cells);
  // One thread alone does not spend that much, all together do.
  set_budget(all - 1);
  CHECK_THROWS_AS(drifts_slowly(filter, set, cells), OutOfBudget);
  set_budget(10'000);
  CHECK_THROWS_AS(drifts_slowly(filter, set, cells), OutOfBudget);
  set_budget(all);
  CHECK(drifts_slowly(filter, set, cells));
  set_budget(kDefaultBudget);
}

TEST_CASE("where the inequality fails on one side of the set only, the set is refused") {
  // The share of noise at which a set of this level is just proved; a little more, and a part of it fails.
  LockSet set = lock_test::WrittenSet().set();
  const LockFilter filter = lock_test::Variances().filter();
  const lock_test::Textbook book{{}, set};
  std::int64_t cells = 0;
  double low = 0.05;
  double high = 0.2;
  for (int k = 0; k < 8; ++k) {
    const double middle = 0.5 * (low + high);
    set.deviation = Ball(middle);
    (drifts_slowly(filter, set, cells) ? low : high) = middle;
  }
  // The textbook: where is the excess largest for a little more?
  test::Random random(5390);
  set.deviation = Ball(low);
  const lock_test::Textbook just{{}, set};
  set.deviation = Ball(1.3 * high);
  const lock_test::Textbook beyond{{}, set};
  int grows = 0;
  for (std::int64_t k = 0; k < test::effort(4000); ++k) {
    const std::array<double, 4> x = lock_test::somewhere(set, random);
    const lock_test::Vector e = just.metric().inverse() * lock_test::Vector(x[0], x[1], x[2]);
    const auto p = just.covariance_of_level(x[3], random);
    CHECK(just.excess(e, p, x[3]) <= 0.0);
    grows += beyond.excess(e, p, x[3]) > 0.0 ? 1 : 0;
  }
  MESSAGE("deviation up to " << low << "; at " << 1.3 * high << " it grows at " << grows << " points");
  CHECK(grows > 0);
}

TEST_CASE("a set whose numbers are no doubles is covered by nothing, which proves nothing") {
  std::int64_t cells = 0;
  LockSet set = lock_test::WrittenSet().set();
  set.level = Ball::everything();
  CHECK_FALSE(drifts_slowly(lock_test::Variances().filter(), set, cells));
  set.level = from_hexadecimal("0x1p+9999");
  CHECK_FALSE(drifts_slowly(lock_test::Variances().filter(), set, cells));
  CHECK(cells == 0);
}
