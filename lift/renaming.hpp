// A ring of past values: at each position of its index the same step, of other cells.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "lift/obligations.hpp"
#include "lift/steps.hpp"

namespace veritrack::lift {

/// The steps of several positions are not one step of other cells.
class StepsDiffer : public LiftError {
 public:
  using LiftError::LiftError;
};

/// For each position, the cells of the next one that have the part of its own cells: the frequency, the
/// obligations and the new states of both positions are then the same formulas. Throws StepsDiffer where
/// there are no such cells.
[[nodiscard]] std::vector<std::map<Spot, Spot>> renamings(Executor& executor, const Orbit& orbit,
                                                          const std::vector<std::set<Spot>>& needed,
                                                          const std::vector<std::vector<Required>>& required);

/// Steps since the cell was written, before the first position; 0 where it never is.
[[nodiscard]] int age_of(const Orbit& orbit, Spot spot);

}  // namespace veritrack::lift
