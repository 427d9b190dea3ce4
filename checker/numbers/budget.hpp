// A limit on the work, so that every file is answered: counted in operations on balls, the same on every
// machine.
#pragma once

#include <cstdint>
#include <stdexcept>

namespace veritrack::checker {

/// The budget is spent. Nothing is verified then.
struct OutOfBudget : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr std::int64_t kDefaultBudget = 4'000'000'000;

namespace detail {
inline std::int64_t budget = kDefaultBudget;
/// The operations of this thread.
inline constinit thread_local std::int64_t spent = 0;
[[noreturn]] void out_of_budget();
}  // namespace detail

/// Starts again with that many operations.
void set_budget(std::int64_t operations);
/// The operations of this thread since then.
inline std::int64_t operations_spent() {
  return detail::spent;
}
/// A thread that works for another begins with the operations that the other has spent; at the end, its own
/// must be counted there.
inline void go_on_from(std::int64_t operations) {
  detail::spent = operations;
}
/// Counts operations. Throws OutOfBudget.
inline void spend(std::int64_t operations = 1) {
  detail::spent += operations;
  if (detail::spent > detail::budget) {
    detail::out_of_budget();
  }
}

}  // namespace veritrack::checker
