#include "checker/model/gain/phase_structure.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "checker/model/gain/exact_number.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kMostPhaseForms = 256;

using Variables = std::vector<std::size_t>;

Variables united(const Variables& x, const Variables& y) {
  Variables result;
  std::set_union(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(result));
  return result;
}

void find_rules(PhaseStructure& structure, bool with_states) {
  const PhaseGraph& graph = structure.graph;
  structure.rule_of.resize(graph.nodes.size());
  std::vector<std::optional<std::size_t>> form_of(graph.nodes.size());
  const auto form = [&](std::size_t node) -> std::optional<std::size_t> {
    if (graph.is_number(node)) {
      return std::nullopt;
    }
    if (!form_of[node]) {
      form_of[node] = structure.forms.size();
      structure.forms.push_back(node);
    }
    return form_of[node];
  };
  for (std::size_t node = 0; node < graph.nodes.size(); ++node) {
    const PhaseNode& of = graph.nodes[node];
    if (!is_nonlinear(graph.nodes, node) && of.operation != PhaseOperation::within) {
      continue;
    }
    PhaseRule rule{node, form(of.first), std::nullopt, std::nullopt};
    if (operands_of(of) > 1) {
      rule.second = form(of.second);
    }
    structure.rule_of[node] = structure.rules.size();
    structure.rules.push_back(rule);
  }
  if (with_states) {
    structure.state_forms.resize(structure.states);
    for (std::size_t node = 0; node < graph.nodes.size(); ++node) {
      if (graph.nodes[node].operation == PhaseOperation::state) {
        structure.state_forms.at(graph.nodes[node].first) = *form(node);
      }
    }
  }
  if (graph.is_number(graph.frequency)) {
    throw NotCovered("the frequency does not depend on the state");
  }
  structure.error_form = *form(graph.frequency);
  if (structure.forms.size() > kMostPhaseForms) {
    throw NotCovered("too many forms");
  }
}

/// The inputs at gates, of the remainders that reach a result.
void find_inputs(PhaseStructure& structure) {
  const std::vector<std::optional<std::size_t>> gates = gates_of(structure.graph);
  structure.input_of.resize(structure.graph.nodes.size());
  for (PhaseRule& rule : structure.rules) {
    const std::optional<std::size_t> gate = gates[rule.node];
    if (!gate || structure.graph.nodes[rule.node].operation == PhaseOperation::within) {
      continue;
    }
    if (!structure.input_of[*gate]) {
      structure.input_of[*gate] = structure.inputs.size();
      structure.inputs.push_back(*gate);
    }
    rule.input = structure.input_of[*gate];
  }
}

/// Adds the remainder of a node, and takes those out that become an input there.
void add_remainders(PhaseStructure& structure, std::size_t node, Variables& of) {
  const std::optional<std::size_t> rule = structure.rule_of[node];
  if (rule && structure.graph.nodes[node].operation != PhaseOperation::within) {
    of = united(of, {structure.remainder(*rule)});
  }
  const std::optional<std::size_t> input = structure.input_of[node];
  if (!input) {
    return;
  }
  for (std::size_t r = 0; r < structure.rules.size(); ++r) {
    if (structure.rules[r].input == input) {
      std::erase(of, structure.remainder(r));
    }
  }
  of = united(of, {structure.input(*input)});
}

void find_slopes(PhaseStructure& structure) {
  for (std::size_t node = 0; node < structure.graph.nodes.size(); ++node) {
    const PhaseNode& of = structure.graph.nodes[node];
    Variables variables;
    if (of.operation == PhaseOperation::state) {
      for (std::size_t j = 0; j < structure.states; ++j) {
        variables.push_back(j);
      }
    } else if (of.operation == PhaseOperation::sample) {
      variables.push_back(structure.noise(of.first));
    }
    for (std::size_t i = 0; i < operands_of(of); ++i) {
      variables = united(variables, structure.slopes[i == 0 ? of.first : of.second]);
    }
    add_remainders(structure, node, variables);
    structure.slopes.push_back(std::move(variables));
  }
}

/// Whether no result depends on a remainder itself: that all of them have come through their gates.
bool is_gated(const PhaseStructure& structure) {
  const std::size_t first = structure.remainder(0);
  const std::size_t last = structure.input(0);
  for (const std::size_t result : structure.graph.results) {
    for (const std::size_t variable : structure.slopes[result]) {
      if (variable >= first && variable < last) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

PhaseStructure phase_structure(PhaseGraph graph, std::size_t states, std::size_t channels, bool with_states) {
  PhaseStructure structure;
  structure.graph = std::move(graph);
  structure.states = states;
  structure.channels = channels;
  find_rules(structure, with_states);
  find_inputs(structure);
  find_slopes(structure);
  if (!is_gated(structure)) {
    throw NotCovered("a remainder that reaches the state beside its gate");
  }
  return structure;
}

}  // namespace veritrack::checker
