// What choices compare and choose: atoms, the same in a formula and in a listing.
#include "checker/code/choice_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace veritrack::checker {

namespace {

using ChoiceKind = FormulaStep::Kind;

constexpr std::size_t kMostAtoms = 24;

}  // namespace

bool ChoiceMatch::is_atom(int place) const {
  return match_->wraps_.is_wrapped(place) || !is_choice_of_registers(match_->listing_->at(place));
}

std::size_t ChoiceMatch::add_number(double number) {
  const auto found = std::find_if(atoms_.begin(), atoms_.end(),
                                  [&](const Atom& atom) { return atom.number && *atom.number == number; });
  if (found == atoms_.end()) {
    atoms_.push_back({-1, number});
    return atoms_.size() - 1;
  }
  return static_cast<std::size_t>(found - atoms_.begin());
}

void ChoiceMatch::add_register(int place) {
  if (of_place_.contains(place)) {
    return;
  }
  const std::optional<double> number = match_->wraps_.number(place);
  if (number) {
    of_place_[place] = add_number(*number);
  } else {
    of_place_[place] = atoms_.size();
    atoms_.push_back({place, std::nullopt});
  }
}

/// The registers that a choice leads to, or compares; false where a condition is of another kind.
bool ChoiceMatch::find_registers(int place) {
  const CodeListing& listing = *match_->listing_;
  std::vector<int> waiting{place};
  std::map<int, bool> is_seen;
  while (!waiting.empty() && atoms_.size() <= kMostAtoms) {
    const int next = match_->wraps_.plain(waiting.back());
    waiting.pop_back();
    if (!is_seen.try_emplace(next, true).second) {
      continue;
    }
    count();
    const ListedOperation& operation = listing.at(next);
    if (is_atom(next)) {
      add_register(next);
    } else if (!operation.is("select")) {
      match_->compared_.insert(operation.operands.begin(), operation.operands.end());
      waiting.insert(waiting.end(), operation.operands.begin(), operation.operands.end());
    } else {
      waiting.push_back(operation.operands[1]);
      waiting.push_back(operation.operands[2]);
      if (!find_condition(operation.operands[0], waiting)) {
        return false;
      }
    }
  }
  return atoms_.size() <= kMostAtoms;
}

bool ChoiceMatch::find_condition(int condition, std::vector<int>& waiting) {
  std::vector<int> conditions{condition};
  while (!conditions.empty()) {
    count();
    const int next = conditions.back();
    conditions.pop_back();
    const ListedOperation& operation = match_->listing_->at(next);
    if (operation.is_bit() || match_->wraps_.tests_for_numbers(next)) {
      continue;
    }
    if (operation.is("and") || operation.is("or") || operation.is("xor") || operation.is("select")) {
      conditions.insert(conditions.end(), operation.operands.begin(), operation.operands.end());
    } else if (ordered_pair(operation)) {
      match_->compared_.insert(operation.operands.begin(), operation.operands.end());
      waiting.insert(waiting.end(), operation.operands.begin(), operation.operands.end());
    } else {
      return false;
    }
  }
  return true;
}

void ChoiceMatch::add_node(int node) {
  if (of_node_.contains(node)) {
    return;
  }
  const FormulaNode& formula = match_->graph_->at(node);
  const bool is_negated = formula.kind == ChoiceKind::negate &&
                          match_->graph_->at(formula.arguments[0]).kind == ChoiceKind::number;
  const std::string& text = is_negated ? match_->graph_->at(formula.arguments[0]).text : formula.text;
  if (is_negated || formula.kind == ChoiceKind::number) {
    const double size = std::strtod(text.c_str(), nullptr);
    const double number = is_negated ? -size : size;
    if (match_->is_constant(node, number)) {
      of_node_[node] = add_number(number);
      return;
    }
  }
  for (std::size_t i = 0; i < atoms_.size(); ++i) {
    if (atoms_[i].place >= 0 && match_->number(node, atoms_[i].place)) {
      of_node_[node] = i;
      return;
    }
  }
  of_node_[node] = atoms_.size();
  atoms_.push_back({});
}

/// Likewise of a formula.
bool ChoiceMatch::find_nodes(int node) {
  const FormulaGraph& graph = *match_->graph_;
  std::vector<int> waiting{node};
  std::map<int, bool> is_seen;
  while (!waiting.empty() && atoms_.size() <= kMostAtoms) {
    const int next = graph.without_limits(waiting.back());
    waiting.pop_back();
    if (!is_seen.try_emplace(next, true).second) {
      continue;
    }
    count();
    const FormulaNode& formula = graph.at(next);
    if (!is_choice_of_formulas(formula)) {
      add_node(next);
      continue;
    }
    waiting.insert(waiting.end(), formula.arguments.begin(), formula.arguments.end());
    if (is_choice(formula.text)) {  // of a difference: its two sides are compared
      waiting.erase(waiting.end() - static_cast<std::ptrdiff_t>(formula.arguments.size()));
      const FormulaNode& difference = graph.at(formula.arguments[0]);
      waiting.insert(waiting.end(), difference.arguments.begin(), difference.arguments.end());
    } else if (formula.negated >= 0) {
      add_node(formula.negated);
    }
  }
  return atoms_.size() <= kMostAtoms;
}

ChoiceMatch::Order ChoiceMatch::order_of_numbers() const {
  Order order;
  order.count = atoms_.size();
  order.known.assign(atoms_.size() * atoms_.size(), 0);
  for (std::size_t a = 0; a < atoms_.size(); ++a) {
    order.known[a * order.count + a] = 1;
    for (std::size_t b = 0; b < atoms_.size(); ++b) {
      if (atoms_[a].number && atoms_[b].number && *atoms_[a].number < *atoms_[b].number) {
        order.known[a * order.count + b] = 2;
      }
    }
  }
  return order;
}

}  // namespace veritrack::checker
