// Which values of a step are forms, which remainders it has, and where they become inputs
// (docs/gain-proof.md, section 10): the same for all phases and frequencies.
#pragma once

#include <optional>
#include <vector>

#include "checker/model/gain/phase_graph.hpp"

namespace veritrack::checker {

/// A remainder, of the operation of this node, or a condition of it alone.
struct PhaseRule {
  std::size_t node = 0;
  std::optional<std::size_t> first, second;  ///< the forms of its operands; none of a number
  std::optional<std::size_t> input;          ///< through which it comes into the state; none: not at all
};

/// Variables of slopes are numbered: first the components of eta, then those of the noise, the remainders by
/// rule, and the inputs.
struct PhaseStructure {
  PhaseGraph graph;
  std::size_t states = 0, channels = 0;
  std::vector<PhaseRule> rules;
  std::vector<std::optional<std::size_t>> rule_of;   ///< by node
  std::vector<std::size_t> forms;                    ///< nodes
  std::size_t error_form = 0;                        ///< of the frequency
  std::vector<std::size_t> state_forms;              ///< by state; none unless they are asked for
  std::vector<std::size_t> inputs;                   ///< the nodes that they are taken in
  std::vector<std::optional<std::size_t>> input_of;  ///< by node
  std::vector<std::vector<std::size_t>> slopes;      ///< by node: the variables that it depends on, in order

  [[nodiscard]] std::size_t noise(std::size_t channel) const { return states + channel; }
  [[nodiscard]] std::size_t remainder(std::size_t rule) const { return states + channels + rule; }
  [[nodiscard]] std::size_t input(std::size_t number) const {
    return states + channels + rules.size() + number;
  }
  [[nodiscard]] std::size_t variables() const { return input(inputs.size()); }
};

/// Throws NotCovered where the method says nothing.
/// `with_states`: the states are forms, too.
PhaseStructure phase_structure(PhaseGraph graph, std::size_t states, std::size_t channels, bool with_states);

}  // namespace veritrack::checker
