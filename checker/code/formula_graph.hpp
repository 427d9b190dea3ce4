// The formulas of a step as one graph: names of lines are looked through.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "checker/model/formula.hpp"

namespace veritrack::checker {

/// A formula's operation on nodes before it.
struct FormulaNode {
  /// What it is; a name is that of a state, a sample or a constant.
  FormulaStep::Kind kind = FormulaStep::Kind::number;
  std::string text;  ///< of a number, a name or a function, as in FormulaStep
  std::vector<int> arguments;
  int exponent = 0;  ///< of a power
  int state = -1;    ///< its number, of the name of a state
  int sample = -1;   ///< likewise of a sample
  int negated = -1;  ///< of abs: the node that is minus its argument

  [[nodiscard]] bool is_function(std::string_view name, std::size_t count) const {
    return kind == FormulaStep::Kind::function && text == name && arguments.size() == count;
  }
};

/// A number, exactly: digits without zeros at their ends, and the power of ten of the last digit.
struct ExactDecimal {
  bool is_negative = false;
  std::string digits;  ///< none: zero
  long power = 0;

  friend bool operator==(const ExactDecimal&, const ExactDecimal&) = default;
};
/// Of the decimal text of a formula. Throws FormulaError for powers beyond 10^9.
ExactDecimal exact_decimal(const std::string& text);
/// Of a finite double.
ExactDecimal exact_decimal(double number);

class FormulaGraph {
 public:
  /// Of the lines of a step and the formula of the frequency. Throws FormulaError.
  FormulaGraph(const std::vector<std::string>& states, const std::vector<std::string>& samples,
               const std::string& step, const std::string& frequency);

  [[nodiscard]] const FormulaNode& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  /// The node of each state after the step.
  [[nodiscard]] const std::vector<int>& next() const { return next_; }
  [[nodiscard]] int frequency() const { return frequency_; }
  /// `name = stays_within(x, low, high)`: the nodes stays_within.
  [[nodiscard]] const std::vector<int>& limits() const { return limits_; }
  /// The node behind stays_within, which is known to be what it limits.
  [[nodiscard]] int without_limits(int node) const {
    while (at(node).is_function("stays_within", 3)) {
      node = at(node).arguments[0];
    }
    return node;
  }
  /// Nodes that have a value wherever the step and its limits have: they are not in a branch of `if` alone.
  [[nodiscard]] const std::vector<bool>& is_always_needed() const { return is_always_needed_; }

 private:
  int add(FormulaNode node);
  int add_formula(const Formula& formula, const std::map<std::string, int>& names);
  void find_needed();

  std::vector<FormulaNode> nodes_;
  std::vector<int> next_, limits_;
  int frequency_ = -1;
  std::vector<bool> is_always_needed_;
};

}  // namespace veritrack::checker
