// The step of a recursion as a graph of operations (docs/gain-proof.md, section 10): recorded once, so that
// what is computed over each cell of phases has the same forms and inputs.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "checker/model/model_recursion.hpp"

namespace veritrack::checker {

enum class PhaseOperation {
  number,
  state,
  sample,
  sum,
  difference,
  negation,
  product,
  reciprocal,
  larger,
  above,  ///< 1 where it is above 0, and 0 where it is below
  within,
  arctangent2,
  sine,
  cosine,
  root,
  exponential,
  logarithm,
  tangent,
  arcsine,
  arccosine,
  arctangent
};

/// A value. Operands are numbers of nodes before it; of a state or sample, `first` is which one.
struct PhaseNode {
  PhaseOperation operation = PhaseOperation::number;
  std::size_t first = 0, second = 0;
  Ball low, high;  ///< the limits of `within`; of a number, `low` is the number
};

/// How many of `first` and `second` are operands.
std::size_t operands_of(const PhaseNode& node);
/// A rule with a remainder is about its operands.
bool is_nonlinear(const std::vector<PhaseNode>& nodes, std::size_t node);

struct PhaseGraph {
  std::vector<PhaseNode> nodes;      ///< operands before what they are used in
  std::vector<std::size_t> results;  ///< by state
  std::size_t frequency = 0;         ///< of the states with which the step begins

  [[nodiscard]] bool is_number(std::size_t node) const {
    return nodes[node].operation == PhaseOperation::number;
  }
};

/// Values without states and samples are numbers. Throws NotCovered for what no rule is about.
PhaseGraph recorded_step(const ModelRecursion& recursion);

/// Values at points of the steady state, by point.
struct SteadyPoint {
  std::vector<double> states, samples;
};

/// The same step, where factors that nearly vanish at these points come last in products of three or more.
PhaseGraph with_small_factors_last(const PhaseGraph& graph, const std::vector<SteadyPoint>& points);

/// By node: the last value before the results through which everything passes that it does to them, or
/// nothing where it does nothing to them.
std::vector<std::optional<std::size_t>> gates_of(const PhaseGraph& graph);

}  // namespace veritrack::checker
