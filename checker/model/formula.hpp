// Formulas of a model, read by the checker itself: into postfix notation, by a stack of operators and without
// recursion, so that no input can exhaust the memory for calls.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "checker/model/piecewise.hpp"
#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// Thrown for text that is not a formula. Says what is wrong and where: the number of the character, from 1.
class FormulaError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// One operation on a stack of values.
struct FormulaStep {
  enum class Kind { number, name, add, subtract, multiply, divide, negate, power, function };
  Kind kind = Kind::number;
  std::string
      text;  ///< of a number, name (with its prime) or function; of a condition "if <": it has x - y, a, b
  int count = 0;  ///< the exponent of a power, the number of arguments of a function
  int slot = 0;   ///< of a number or name, once it is looked up: see ModelRecursion
};

/// A formula in postfix notation.
using Formula = std::vector<FormulaStep>;

/// `name = value`; the name has a prime if it is the next value of a state.
struct FormulaLine {
  std::string name;
  Formula value;
};

/// Throws FormulaError.
Formula read_formula(std::string_view text);
/// A definition on each line; lines may be empty or end with a comment, and go on while parentheses are open.
/// Throws FormulaError.
std::vector<FormulaLine> read_lines(std::string_view text);

/// The lines in an order in which each needs only names that stand before it. Throws FormulaError for a name
/// that is defined twice, and for lines that need each other.
std::vector<FormulaLine> in_order_of_need(const std::vector<FormulaLine>& lines);

/// `name = stays_within(x, low, high)`: has to be shown, whether or not anything needs the name.
bool is_limit(const FormulaLine& line);

/// state' = wrap(formula) becomes state' = formula, where the state is one of the angles, which are known
/// modulo 2 pi only, and no formula uses state'.
void leave_out_outer_wraps(std::vector<FormulaLine>& lines, const std::vector<std::string>& angles);

/// A line, not itself a limit, that neither one of `results` nor a limit needs, or nullptr. The lines are in
/// order.
const FormulaLine* unused_line(const std::vector<FormulaLine>& ordered,
                               const std::vector<std::string>& results);

/// The value of a formula over any scalar that has arithmetic, sqrt, exp, log, sin, cos, tangent, arcsine,
/// arccosine, arctangent, arctangent2, stays_within and the functions of piecewise.hpp. `leaf` gives the
/// values of numbers and names. Throws FormulaError for a function that is unknown, or has the wrong number
/// of arguments.
template <typename Scalar, typename Leaf>
Scalar value_of(const Formula& formula, const Leaf& leaf);

// ---- how

/// x^n, by squaring from the highest bit of n down; x^0 is 1, which no formula has.
template <typename Scalar>
Scalar whole_power(const Scalar& x, int n) {
  if (n == 0) {
    return Scalar(1.0);
  }
  Scalar result = x;
  int bit = 1;
  while (bit <= n / 2) {
    bit *= 2;
  }
  for (bit /= 2; bit > 0; bit /= 2) {
    result = result * result;
    result = (n & bit) != 0 ? result * x : result;
  }
  return result;
}

inline Ball tangent(const Ball& x) {
  return value_of_arb(arb_tan, x);
}
inline Ball arccosine(const Ball& x) {
  return value_of_arb(arb_acos, x);
}
inline Ball arctangent2(const Ball& y, const Ball& x) {
  return value_of_arb(arb_atan2, y, x);
}
/// x, or nothing known unless certainly low < x < high.
inline Ball stays_within(const Ball& x, const Ball& low, const Ball& high) {
  return certainly_less(low, x) && certainly_less(x, high) ? x : Ball::everything();
}

template <typename Scalar>
Scalar value_of_function(const std::string& name, const std::vector<Scalar>& arguments) {
  const auto is = [&](std::string_view known, std::size_t count) {
    return name == known && arguments.size() == count;
  };
  if (is("sqrt", 1)) {
    return sqrt(arguments[0]);
  }
  if (is("exp", 1)) {
    return exp(arguments[0]);
  }
  if (is("log", 1)) {
    return log(arguments[0]);
  }
  if (is("sin", 1)) {
    return sin(arguments[0]);
  }
  if (is("cos", 1)) {
    return cos(arguments[0]);
  }
  if (is("tan", 1)) {
    return tangent(arguments[0]);
  }
  if (is("asin", 1)) {
    return arcsine(arguments[0]);
  }
  if (is("acos", 1)) {
    return arccosine(arguments[0]);
  }
  if (is("atan", 1)) {
    return arctangent(arguments[0]);
  }
  if (is("atan2", 2)) {
    return arctangent2(arguments[0], arguments[1]);
  }
  if (is("hypot", 2)) {
    return sqrt(Scalar(whole_power(arguments[0], 2) + whole_power(arguments[1], 2)));
  }
  if (is("tanh", 1)) {
    const Scalar growth = exp(Scalar(Scalar(2.0) * arguments[0]));
    return Scalar(1.0) - Scalar(2.0) / (growth + Scalar(1.0));
  }
  if (is("wrap", 1)) {
    return arctangent2(Scalar(sin(arguments[0])), Scalar(cos(arguments[0])));
  }
  if (is("stays_within", 3)) {
    return stays_within(arguments[0], arguments[1], arguments[2]);
  }
  if (std::optional<Scalar> value = value_of_piecewise(name, arguments)) {
    return *std::move(value);
  }
  throw FormulaError("no function " + name + " with that many arguments");
}

template <typename Scalar, typename Leaf>
Scalar value_of(const Formula& formula, const Leaf& leaf) {
  using Kind = FormulaStep::Kind;
  std::vector<Scalar> stack;
  const auto pop = [&] {
    if (stack.empty()) {
      throw FormulaError("a formula that is not whole");
    }
    Scalar top = std::move(stack.back());
    stack.pop_back();
    return top;
  };
  for (const FormulaStep& step : formula) {
    switch (step.kind) {
      case Kind::number:
      case Kind::name:
        stack.push_back(leaf(step));
        break;
      case Kind::negate:
        stack.push_back(-pop());
        break;
      case Kind::power:
        stack.push_back(whole_power(pop(), step.count));
        break;
      case Kind::function: {
        std::vector<Scalar> arguments;
        for (int i = 0; i < step.count; ++i) {
          arguments.insert(arguments.begin(), pop());
        }
        stack.push_back(value_of_function(step.text, arguments));
        break;
      }
      default: {
        const Scalar second = pop();
        const Scalar first = pop();
        stack.push_back(step.kind == Kind::add        ? first + second
                        : step.kind == Kind::subtract ? first - second
                        : step.kind == Kind::multiply ? first * second
                                                      : first / second);
      }
    }
  }
  if (stack.size() != 1) {
    throw FormulaError("a formula that is not whole");
  }
  return stack.back();
}

}  // namespace veritrack::checker
