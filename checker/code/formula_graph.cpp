#include "checker/code/formula_graph.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace veritrack::checker {

namespace {

using Kind = FormulaStep::Kind;

constexpr std::size_t kMostNodes = 200'000;

ExactDecimal without_zeros(ExactDecimal number) {
  const std::size_t first = number.digits.find_first_not_of('0');
  if (first == std::string::npos) {
    return {};
  }
  number.digits.erase(0, first);
  while (number.digits.back() == '0') {
    number.digits.pop_back();
    ++number.power;
  }
  return number;
}

}  // namespace

ExactDecimal exact_decimal(const std::string& text) {
  const std::size_t exponent = text.find_first_of("eE");
  ExactDecimal result;
  bool is_behind_point = false;
  for (const char letter : text.substr(0, exponent)) {
    if (letter == '.') {
      is_behind_point = true;
    } else {
      result.digits += letter;
      result.power -= is_behind_point ? 1 : 0;
    }
  }
  if (exponent != std::string::npos) {
    const char* begin = text.data() + exponent + 1;
    const char* end = text.data() + text.size();
    begin += begin != end && *begin == '+' ? 1 : 0;
    long power = 0;
    const auto [read, error] = std::from_chars(begin, end, power);
    constexpr long kFarthest = 1'000'000'000;
    if (error != std::errc() || read != end || power > kFarthest || power < -kFarthest) {
      throw FormulaError("a number with an exponent that is not allowed");
    }
    result.power += power;
  }
  return without_zeros(std::move(result));
}

ExactDecimal exact_decimal(double number) {
  constexpr int kAllDigits = 800;  // no double has more than 767
  std::array<char, kAllDigits + 32> text{};
  // Exact, so that no rounding mode matters.
  std::snprintf(text.data(), text.size(), "%.*e", kAllDigits, std::fabs(number));
  ExactDecimal result = exact_decimal(std::string(text.data()));
  result.is_negative = number < 0.0;
  return result;
}

int FormulaGraph::add(FormulaNode node) {
  if (nodes_.size() >= kMostNodes) {
    throw FormulaError("more formulas than functions have");
  }
  nodes_.push_back(std::move(node));
  return static_cast<int>(nodes_.size()) - 1;
}

int FormulaGraph::add_formula(const Formula& formula, const std::map<std::string, int>& names) {
  std::vector<int> stack;
  for (const FormulaStep& step : formula) {
    if (const auto known = names.find(step.text); step.kind == Kind::name && known != names.end()) {
      stack.push_back(known->second);
      continue;
    }
    const bool is_leaf = step.kind == Kind::number || step.kind == Kind::name;
    const int count = is_leaf                                                 ? 0
                      : step.kind == Kind::function                           ? step.count
                      : step.kind == Kind::negate || step.kind == Kind::power ? 1
                                                                              : 2;
    if (count < 0 || stack.size() < static_cast<std::size_t>(count)) {
      throw FormulaError("a formula that is not whole");
    }
    FormulaNode node;
    node.kind = step.kind;
    node.text = step.text;
    node.exponent = step.kind == Kind::power ? step.count : 0;
    node.arguments.assign(stack.end() - count, stack.end());
    stack.resize(stack.size() - static_cast<std::size_t>(count));
    const bool is_if = node.kind == Kind::function && is_choice(node.text);
    if (is_if && (node.arguments.size() != 3 || at(node.arguments[0]).kind != Kind::subtract)) {
      throw FormulaError("a choice that is not between two by a comparison");
    }
    if (node.is_function("abs", 1)) {
      FormulaNode negated;
      negated.kind = Kind::negate;
      negated.arguments = node.arguments;
      node.negated = add(std::move(negated));
    }
    stack.push_back(add(std::move(node)));
  }
  if (stack.size() != 1) {
    throw FormulaError("a formula that is not whole");
  }
  return stack.back();
}

FormulaGraph::FormulaGraph(const std::vector<std::string>& states, const std::vector<std::string>& samples,
                           const std::string& step, const std::string& frequency) {
  std::map<std::string, int> names;
  const auto add_input = [&](const std::string& name, int state, int sample) {
    FormulaNode node;
    node.kind = Kind::name;
    node.text = name;
    node.state = state;
    node.sample = sample;
    if (!names.emplace(name, add(std::move(node))).second) {
      throw FormulaError(name + " has two meanings");
    }
  };
  for (std::size_t i = 0; i < states.size(); ++i) {
    add_input(states[i], static_cast<int>(i), -1);
  }
  frequency_ = add_formula(read_formula(frequency), names);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    add_input(samples[i], -1, static_cast<int>(i));
  }
  for (const FormulaLine& line : in_order_of_need(read_lines(step))) {
    const int value = add_formula(line.value, names);
    if (is_limit(line)) {
      limits_.push_back(value);
    }
    if (!names.emplace(line.name, value).second) {
      throw FormulaError(line.name + " has two meanings");
    }
  }
  for (const std::string& state : states) {
    const auto found = names.find(state + "'");
    if (found == names.end()) {
      throw FormulaError("the state " + state + " has no next value");
    }
    next_.push_back(found->second);
  }
  find_needed();
}

void FormulaGraph::find_needed() {
  is_always_needed_.assign(nodes_.size(), false);
  for (const std::vector<int>* roots : {&next_, &limits_}) {
    for (const int root : *roots) {
      is_always_needed_[static_cast<std::size_t>(root)] = true;
    }
  }
  for (std::size_t i = nodes_.size(); i-- > 0;) {  // arguments stand before
    const FormulaNode& node = nodes_[i];
    if (is_always_needed_[i]) {
      const bool is_if = node.kind == Kind::function && is_choice(node.text);
      const std::size_t count = is_if ? 1 : node.arguments.size();
      for (std::size_t k = 0; k < count; ++k) {
        is_always_needed_[static_cast<std::size_t>(node.arguments[k])] = true;
      }
    }
  }
}

}  // namespace veritrack::checker
