// A branch of fixed points X*(p), followed from one parameter value in verified steps.
#pragma once

#include <string>
#include <vector>

#include "analysis/sets/fixed_point.hpp"

namespace veritrack::sets {

/// Cells in the order in which they were verified. Neighbours share a parameter value, at which they were
/// shown to hold the same fixed point, so that together they hold one continuously differentiable branch.
template <int N>
struct FixedPointBranch {
  std::vector<FixedPointFamily<N>> cells;
  double reached = 0.0;   ///< the branch is verified from its start up to here
  bool complete = false;  ///< `reached` is where it was to go
};

/// How far a step may go, in units of the parameter.
struct BranchSteps {
  double largest = 0.05;
  double smallest = 1e-5;
};

/// Follows the branch from `start`, an enclosure of the one fixed point at the parameter `from` that is
/// meant, to `to` (either side). Stops at the first cell of the smallest width that could not be verified.
/// Holds its own rounding mode.
template <typename Loop>
[[nodiscard]] FixedPointBranch<Loop::kStates> follow_branch(const Loop& loop,
                                                            const rigor::IntervalVector<Loop::kStates>& start,
                                                            double from, double to,
                                                            const BranchSteps& steps = {}) {
  constexpr int kSize = Loop::kStates;
  using rigor::Interval;
  const rigor::UpwardRounding upward;
  FixedPointBranch<kSize> branch;
  branch.reached = from;
  branch.complete = from == to;
  rigor::IntervalVector<kSize> here = start;
  const double direction = to > from ? 1.0 : -1.0;
  double step = steps.largest;
  while (!branch.complete && step >= steps.smallest && std::isfinite(to)) {
    const double next = direction * (to - (branch.reached + direction * step)) <= 0.0
                            ? to
                            : branch.reached + direction * step;
    const Interval cell =
        Interval::from_bounds(std::min(branch.reached, next), std::max(branch.reached, next));
    const Interval shared(branch.reached);
    const auto tube = verify_fixed_point(loop, rigor::Vector<kSize>(midpoint(here)), cell);
    if (!tube || !holds_one_fixed_point<Loop>(loop, hull(here, tube->at(shared)), shared)) {
      step *= 0.5;
      continue;
    }
    here = tube->at(Interval(next));
    branch.cells.push_back(*tube);
    branch.reached = next;
    branch.complete = next == to;
    step = std::min(2.0 * step, steps.largest);
  }
  return branch;
}

}  // namespace veritrack::sets
