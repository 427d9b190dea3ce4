#include "checker/code/choice_match.hpp"

#include <algorithm>

#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

using ChoiceKind = FormulaStep::Kind;

constexpr int kMostSteps = 20'000;
constexpr int kDeepestChoice = 100;

/// No rule decides: there are too many cases, they are nested too deeply, or a value may be undefined.
struct NoCase {};

}  // namespace

bool is_choice_of_registers(const ListedOperation& operation) {
  return (operation.is("select") && operation.format.is_float) || operation.is("fmin") ||
         operation.is("fmax");
}

bool is_choice_of_formulas(const FormulaNode& node) {
  return node.is_function("min", 2) || node.is_function("max", 2) || node.is_function("clamp", 3) ||
         node.is_function("abs", 1) || (node.kind == ChoiceKind::function && is_choice(node.text));
}

bool ChoiceMatch::Order::add(std::size_t a, std::size_t b, bool is_less) {
  const auto strength = [&](std::size_t x, std::size_t y) -> std::uint8_t& { return known[x * count + y]; };
  if (strength(b, a) == 2 || (is_less && strength(b, a) == 1)) {
    return false;
  }
  const std::uint8_t added = is_less ? 2 : 1;
  if (strength(a, b) >= added) {
    return true;
  }
  const std::vector<std::uint8_t> before = known;
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t q = 0; q < count; ++q) {
      const std::uint8_t to_a = before[p * count + a];
      const std::uint8_t from_b = before[b * count + q];
      if (to_a > 0 && from_b > 0) {
        strength(p, q) = std::max({strength(p, q), to_a, added, from_b});
      }
    }
  }
  return true;
}

void ChoiceMatch::count() {
  spend();
  if (++steps_ > kMostSteps) {
    throw NoCase();
  }
}

// ---- values for each order

void ChoiceMatch::compare(const Order& order, std::size_t a, std::size_t b, Relation relation,
                          bool is_opposite, Truths& found) {
  const auto add = [&](std::size_t x, std::size_t y, bool is_less, bool holds) {
    Order more = order;
    if (more.add(x, y, is_less)) {
      found.emplace_back(std::move(more), holds != is_opposite);
    }
  };
  if (relation != Relation::equal) {
    add(a, b, relation == Relation::less, true);
    add(b, a, relation == Relation::at_most, false);
    return;
  }
  add(a, b, true, false);
  add(b, a, true, false);
  Order more = order;
  if (more.add(a, b, false) && more.add(b, a, false)) {
    found.emplace_back(std::move(more), !is_opposite);
  }
}

ChoiceMatch::Truths ChoiceMatch::of_comparison(const OrderedPair& pair, const Order& order) {
  Truths found;
  for (const auto& [with_first, first] : of_register(pair.first, order)) {
    for (const auto& [with_both, second] : of_register(pair.second, with_first)) {
      count();
      compare(with_both, first, second, pair.relation, pair.is_opposite, found);
    }
  }
  return found;
}

ChoiceMatch::Truths ChoiceMatch::of_condition(int condition, const Order& order) {
  count();
  const ListedOperation& operation = match_->listing_->at(condition);
  if (operation.is_bit()) {
    return {{order, operation.integer != 0}};
  }
  if (const std::optional<bool> are_numbers = match_->wraps_.tests_for_numbers(condition)) {
    return {{order, *are_numbers}};
  }
  if (const auto pair = ordered_pair(operation)) {
    return of_comparison(*pair, order);
  }
  if (++depth_ > kDeepestChoice) {
    throw NoCase();
  }
  Truths found;
  for (const auto& [with_first, first] : of_condition(operation.operands[0], order)) {
    if (operation.is("select")) {
      const Truths chosen = of_condition(operation.operands[first ? 1 : 2], with_first);
      found.insert(found.end(), chosen.begin(), chosen.end());
      continue;
    }
    for (const auto& [with_both, second] : of_condition(operation.operands[1], with_first)) {
      found.emplace_back(with_both, operation.is("and")  ? first && second
                                    : operation.is("or") ? first || second
                                                         : first != second);
    }
  }
  --depth_;
  return found;
}

ChoiceMatch::Values ChoiceMatch::of_register(int place, const Order& order) {
  count();
  place = match_->wraps_.plain(place);
  if (is_atom(place)) {
    return {{order, of_place_.at(place)}};
  }
  if (++depth_ > kDeepestChoice) {
    throw NoCase();
  }
  const ListedOperation& operation = match_->listing_->at(place);
  const bool selects = operation.is("select");
  const bool takes_first_if_less = !operation.is("fmax");
  const Truths truths =
      selects
          ? of_condition(operation.operands[0], order)
          : of_comparison({operation.operands[0], operation.operands[1], Relation::at_most, false}, order);
  Values found;
  for (const auto& [where, holds] : truths) {
    const std::size_t taken = holds == takes_first_if_less ? 0 : 1;
    const Values branch = of_register(operation.operands[taken + (selects ? 1 : 0)], where);
    found.insert(found.end(), branch.begin(), branch.end());
  }
  --depth_;
  return found;
}

ChoiceMatch::Values ChoiceMatch::of_node(int node, const Order& order) {
  count();
  node = match_->graph_->without_limits(node);
  const FormulaNode& formula = match_->graph_->at(node);
  if (!is_choice_of_formulas(formula)) {
    return {{order, of_node_.at(node)}};
  }
  if (++depth_ > kDeepestChoice) {
    throw NoCase();
  }
  const std::vector<int>& arguments = formula.arguments;
  const std::vector<int>& sides =
      is_choice(formula.text) ? match_->graph_->at(arguments[0]).arguments : arguments;
  Values found;
  for (const auto& [with_first, first] : of_node(sides[0], order)) {
    if (formula.text == "abs") {
      add_absolute(with_first, first, of_node_.at(formula.negated), found);
      continue;
    }
    for (const auto& [with_both, second] : of_node(sides[1], with_first)) {
      count();
      if (formula.text == "clamp") {
        add_clamp(with_both, {first, second}, arguments[2], found);
      } else {
        add_chosen(formula, with_both, {first, second}, found);
      }
    }
  }
  --depth_;
  return found;
}

/// min, max or if of two values.
void ChoiceMatch::add_chosen(const FormulaNode& formula, const Order& order,
                             std::pair<std::size_t, std::size_t> sides, Values& found) {
  const auto [first, second] = sides;
  const bool is_turned = formula.text == "if >" || formula.text == "if >=";
  const bool is_strict = formula.text == "if <" || formula.text == "if >";
  Truths truths;
  compare(order, is_turned ? second : first, is_turned ? first : second,
          is_strict ? Relation::less : Relation::at_most, false, truths);
  for (const auto& [where, holds] : truths) {
    if (is_choice(formula.text)) {
      const Values branch = of_node(formula.arguments[holds ? 1 : 2], where);
      found.insert(found.end(), branch.begin(), branch.end());
    } else {
      found.emplace_back(where, holds == (formula.text == "min") ? first : second);
    }
  }
}

/// |x|, by x and -x.
void ChoiceMatch::add_absolute(const Order& order, std::size_t value, std::size_t negated, Values& found) {
  Order below = order;
  if (below.add(value, zero_, true)) {
    found.emplace_back(std::move(below), negated);
  }
  Order above = order;
  if (above.add(zero_, value, true)) {
    found.emplace_back(std::move(above), value);
  }
  Order at_zero = order;
  if (at_zero.add(value, zero_, false) && at_zero.add(zero_, value, false) &&
      at_zero.add(negated, zero_, false) && at_zero.add(zero_, negated, false)) {
    found.emplace_back(std::move(at_zero), zero_);
  }
}

/// clamp(x, low, high), where low <= high is known.
void ChoiceMatch::add_clamp(const Order& order, std::pair<std::size_t, std::size_t> value_and_low, int upper,
                            Values& found) {
  const auto [value, low] = value_and_low;
  for (const auto& [with_high, high] : of_node(upper, order)) {
    count();
    if (with_high.known[low * with_high.count + high] == 0) {
      throw NoCase();
    }
    Truths below;
    compare(with_high, value, low, Relation::at_most, false, below);
    for (const auto& [where, is_below] : below) {
      Truths above;
      compare(where, high, value, Relation::at_most, false, above);
      for (const auto& [there, is_above] : above) {
        found.emplace_back(there, is_below ? low : is_above ? high : value);
      }
    }
  }
}

bool ChoiceMatch::is_same(int node, int place) {
  try {
    zero_ = add_number(0.0);
    if (!find_registers(place) || !find_nodes(node)) {
      return false;
    }
    for (const auto& [with_register, listed] : of_register(place, order_of_numbers())) {
      for (const auto& [with_both, written] : of_node(node, with_register)) {
        if (listed != written && !with_both.are_equal(listed, written)) {
          return false;
        }
      }
    }
    return true;
  } catch (const NoCase&) {
    return false;
  }
}

}  // namespace veritrack::checker
