#include "checker/numbers/budget.hpp"

#include <string>

namespace veritrack::checker {

void detail::out_of_budget() {
  throw OutOfBudget("the budget of " + std::to_string(budget) + " operations is spent");
}

void set_budget(std::int64_t operations) {
  detail::budget = operations;
  detail::spent = 0;
}

}  // namespace veritrack::checker
