// Formulas as a user writes them: trees whose nodes record their place in the file.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "certificates/design/design.hpp"

namespace veritrack::certificates::language {

/// Thrown for a formula that cannot be used: what() states the fault and what is allowed.
class LanguageError : public std::runtime_error {
 public:
  LanguageError(Position position, const std::string& message)
      : std::runtime_error(message), position_(position) {}
  [[nodiscard]] Position position() const noexcept { return position_; }

 private:
  Position position_;
};

/// A formula. Operands stand in the order in which they are written.
struct Expression {
  /// A comparison, < <= > >=, is the first argument of a call of `if`, and nothing else.
  enum class Kind { number, name, negation, sum, difference, product, quotient, power, call, comparison };
  Kind kind = Kind::number;
  Position position;
  /// number: as written; name: with the prime of a next value; call: the function; comparison: its sign.
  std::string text;
  int exponent = 0;  ///< of power
  int depth = 0;     ///< operations one inside the other, this one included
  std::vector<Expression> operands;
  bool is_wrap = false;  ///< atan2 of the sine and the cosine of one formula: it was written as wrap(...)
};

/// One line of a step: `name = value`, or `state' = value` for a next value.
struct Definition {
  std::string name;  ///< with the prime
  Position position;
  Expression value;
};

/// Calls `visit` for every leaf.
template <typename Visit>
void for_each_leaf(const Expression& expression, const Visit& visit) {
  if (expression.operands.empty()) {
    visit(expression);
  }
  for (const Expression& operand : expression.operands) {
    for_each_leaf(operand, visit);
  }
}

/// The text as a formula. Parentheses may be 64 deep. Throws LanguageError.
[[nodiscard]] Expression parse_expression(const SourceText& source);

/// The definitions, one on each line; a line may be empty, or end with a comment that begins with #. A line
/// whose parentheses are open goes on with the next one. Throws LanguageError.
[[nodiscard]] std::vector<Definition> parse_definitions(const SourceText& source);

}  // namespace veritrack::certificates::language
