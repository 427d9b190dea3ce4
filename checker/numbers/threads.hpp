// Work that is shared among threads, with the budget of operations.
#pragma once

#include <cstddef>
#include <functional>

namespace veritrack::checker {

/// Calls `work` with 0, 1, ..., each once and in this order, by as many threads as there are processors,
/// until one of the calls returns false: then those below it have also been made. Returns the least index
/// that returned false, or `count`. Throws what a call throws; OutOfBudget also when all threads together
/// spend more than the budget.
std::size_t first_failure(std::size_t count, const std::function<bool(std::size_t)>& work);

}  // namespace veritrack::checker
