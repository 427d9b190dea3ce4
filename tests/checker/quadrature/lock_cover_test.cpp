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

TEST_CASE("a set is proved and refused as the textbook says") {
  const LockFilter filter = lock_test::Variances().filter();
  test::Random random(5390);
  for (const auto& [deviation, is_proved] : {std::pair{0.07, true}, std::pair{0.105, false}}) {
    CAPTURE(deviation);
    LockSet set = lock_test::WrittenSet().set();
    set.deviation = Ball(deviation);
    std::int64_t cells = 0;
    CHECK(drifts_slowly(filter, set, cells) == is_proved);
    const lock_test::Textbook book{{}, set};
    int grows = 0;
    for (std::int64_t k = 0; k < test::effort(4000); ++k) {
      const std::array<double, 4> x = lock_test::somewhere(set, random);
      const lock_test::Vector e = book.metric().inverse() * lock_test::Vector(x[0], x[1], x[2]);
      grows += book.excess(e, book.covariance_of_level(x[3], random), x[3]) > 0.0 ? 1 : 0;
    }
    CHECK((grows == 0) == is_proved);
  }
}

TEST_CASE("with a leak the set has no mirror image, and its bias and frequencies count") {
  const LockFilter filter = lock_test::leaking_variances().filter();
  const LockSet set = lock_test::leaking_set();
  std::int64_t cells = 0;
  CHECK(drifts_slowly(filter, set, cells));
  std::int64_t half_as_many = 0;
  CHECK(drifts_slowly(lock_test::Variances().filter(), lock_test::WrittenSet().set(), half_as_many));
  CHECK(cells > half_as_many);
  LockSet mirrored = set;
  mirrored.lowest_frequency = Ball(-1.6);
  mirrored.highest_frequency = Ball(-1.4);
  CHECK_FALSE(drifts_slowly(filter, mirrored, cells));
  mirrored.bias[1] = -set.bias[1];
  mirrored.bias[2] = -set.bias[2];
  CHECK(drifts_slowly(filter, mirrored, cells));
  LockSet with_more_frequencies = set;
  with_more_frequencies.highest_frequency = Ball(30.0);
  CHECK_FALSE(drifts_slowly(filter, with_more_frequencies, cells));
  LockSet with_another_bias = set;
  with_another_bias.bias[2] = Ball(0.25);
  CHECK_FALSE(drifts_slowly(filter, with_another_bias, cells));
}

TEST_CASE("a set about a bias of the phase or of the frequency has no mirror image, without a leak either") {
  const LockFilter filter = lock_test::Variances().filter();
  std::int64_t half_as_many = 0;
  CHECK(drifts_slowly(filter, lock_test::WrittenSet().set(), half_as_many));
  for (const std::size_t i : {1U, 2U}) {
    CAPTURE(i);
    LockSet set = lock_test::WrittenSet().set();
    set.bias[i] = Ball(0x1p-40);
    std::int64_t cells = 0;
    CHECK(drifts_slowly(filter, set, cells));
    CHECK(2 * cells > 3 * half_as_many);
  }
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
