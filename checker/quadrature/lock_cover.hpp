// Cells that cover a set, bisected until an inequality is proved in each.
#pragma once

#include <cstdint>

#include "checker/quadrature/lock_inequality.hpp"

namespace veritrack::checker {

/// True only when the inequality of `left` is proved wherever the level of (e, P) is at most L. `cells`
/// counts the cells that were examined. Cells are shared among threads; neither the verdict nor, where it is
/// proved, the count depends on the number of threads. Throws OutOfBudget.
bool holds_in_set(const LockFilter& filter, const LockSet& set, const LockLeft& left, std::int64_t& cells);

/// The same for the drift inequality.
bool drifts_slowly(const LockFilter& filter, const LockSet& set, std::int64_t& cells);

}  // namespace veritrack::checker
