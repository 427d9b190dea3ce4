// Which conditions of the executor a listing needs, and where.
#pragma once

#include <set>
#include <vector>

#include "lift/steps.hpp"

namespace veritrack::lift {

/// The registers that some need: a mark for each register.
[[nodiscard]] std::vector<bool> needed_by(const Graph& graph, const std::vector<int>& roots);

/// A condition as one register that has to be 0.
struct Required {
  int must_be_zero = -1;
  const Condition* condition = nullptr;
};

/// The states on which frequencies, obligations and states that are needed depend, at each position: those
/// before the step. Throws LiftError where one is not defined.
[[nodiscard]] std::vector<std::set<Spot>> needed_states(Executor& executor, const Orbit& orbit);

/// The obligations of a position, from the states that are needed after its step. A value that may be
/// undefined only matters where a select takes it.
[[nodiscard]] std::vector<Required> obligations_of(Graph& graph, const Position& position,
                                                   const std::set<Spot>& needed_after);

}  // namespace veritrack::lift
