// Work shared among threads: everything below a failure is done, what is thrown arrives, and the budget is
// one.
#include "checker/numbers/threads.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <vector>

#include "checker/numbers/budget.hpp"

using namespace veritrack::checker;

TEST_CASE("every index is taken once when none fails") {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
    std::vector<std::atomic<int>> calls(count);
    CHECK(first_failure(count, [&](std::size_t k) {
            ++calls[k];
            return true;
          }) == count);
    for (const auto& number : calls) {
      CHECK(number == 1);
    }
  }
}

TEST_CASE("the least index that fails is the answer, whichever thread is the first") {
  const std::set<std::size_t> failing{700, 300, 301, 302, 950};
  for (int repetition = 0; repetition < 20; ++repetition) {
    std::vector<std::atomic<int>> calls(1000);
    CHECK(first_failure(calls.size(), [&](std::size_t k) {
            ++calls[k];
            return failing.count(k) == 0;
          }) == 300);
    for (std::size_t k = 0; k <= 300; ++k) {
      CHECK(calls[k] == 1);
    }
  }
}

TEST_CASE("what a call throws is thrown") {
  CHECK_THROWS_AS((void)first_failure(100,
                                      [](std::size_t k) -> bool {
                                        if (k == 40) {
                                          throw std::runtime_error("forty");
                                        }
                                        return true;
                                      }),
                  std::runtime_error);
}

TEST_CASE("all threads spend of one budget") {
  set_budget(1000);
  const auto spend_ten = [](std::size_t) {
    spend(10);
    return true;
  };
  CHECK(first_failure(50, spend_ten) == 50);
  CHECK(operations_spent() == 500);
  CHECK_THROWS_AS((void)first_failure(60, spend_ten), OutOfBudget);
  set_budget(kDefaultBudget);
}
