#include "checker/numbers/budget.hpp"

#include <doctest/doctest.h>

#include "checker/numbers/ball.hpp"

using namespace veritrack::checker;

TEST_CASE("operations are counted, the same every time, and end at the budget") {
  const auto work = [] {
    Ball sum(0.0);
    for (int i = 0; i < 100; ++i) {
      sum += square(Ball(i)) * Ball(2.0);
    }
    return operations_spent();
  };
  set_budget(kDefaultBudget);
  const auto first = work();
  CHECK(first == 300);
  set_budget(kDefaultBudget);
  CHECK(work() == first);
  set_budget(299);
  CHECK_THROWS_AS(work(), OutOfBudget);
  set_budget(kDefaultBudget);
}
