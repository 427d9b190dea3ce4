#include "certificates/model/language/written_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace veritrack::certificates::language {

namespace {

using Kind = Expression::Kind;

constexpr std::size_t kLongest = 4000;  // operations and names

std::size_t length_of(const Expression& expression) {
  std::size_t length = 1;
  for (const Expression& operand : expression.operands) {
    length += length_of(operand);
  }
  return length;
}

Expression made(Kind kind, Position position, std::string text, std::vector<Expression> operands,
                int exponent = 0) {
  Expression expression{kind, position, std::move(text), exponent, 0, {}};
  for (const Expression& operand : operands) {
    expression.depth = std::max(expression.depth, operand.depth + 1);
  }
  expression.operands = std::move(operands);
  return expression;
}

}  // namespace

const std::vector<std::string>& written_out_functions() {
  static const std::vector<std::string> names{"hypot", "tanh", "wrap"};
  return names;
}

std::size_t arguments_of_written_out(std::string_view name) {
  return name == "hypot" ? 2 : name == "tanh" || name == "wrap" ? 1 : 0;
}

std::optional<Expression> written_out(std::string_view name, Position position,
                                      const std::vector<Expression>& arguments) {
  if (arguments.size() != arguments_of_written_out(name) || arguments.empty()) {
    return std::nullopt;
  }
  const auto number = [&](const char* text) { return made(Kind::number, position, text, {}); };
  const auto call = [&](const char* function, std::vector<Expression> operands) {
    return made(Kind::call, position, function, std::move(operands));
  };
  const auto both = [&](Kind kind, Expression a, Expression b) {
    std::vector<Expression> operands;
    operands.push_back(std::move(a));
    operands.push_back(std::move(b));
    return made(kind, position, "", std::move(operands));
  };
  std::optional<Expression> result;
  if (name == "hypot") {
    result = call("sqrt", {both(Kind::sum, made(Kind::power, position, "", {arguments[0]}, 2),
                                made(Kind::power, position, "", {arguments[1]}, 2))});
  } else if (name == "tanh") {
    const Expression growth = call("exp", {both(Kind::product, number("2"), arguments[0])});
    result = both(Kind::difference, number("1"),
                  both(Kind::quotient, number("2"), both(Kind::sum, growth, number("1"))));
  } else if (name == "wrap") {
    result = call("atan2", {call("sin", {arguments[0]}), call("cos", {arguments[0]})});
    result->is_wrap = true;
  }
  if (result && length_of(*result) > kLongest) {
    throw LanguageError(
        position,
        fmt::format("{} of a formula that is too long; allowed: {} operations and names", name, kLongest));
  }
  return result;
}

void leave_out_outer_wraps(std::vector<Definition>& step, const std::vector<std::string>& angles) {
  const auto is_used = [&](const std::string& name) {
    return std::any_of(step.begin(), step.end(), [&](const Definition& definition) {
      bool found = false;
      for_each_leaf(definition.value, [&](const Expression& leaf) { found = found || leaf.text == name; });
      return found;
    });
  };
  for (Definition& definition : step) {
    const bool is_next_of_angle = std::any_of(angles.begin(), angles.end(), [&](const std::string& angle) {
      return definition.name == angle + "'";
    });
    while (is_next_of_angle && definition.value.is_wrap && !is_used(definition.name)) {
      Expression inside = definition.value.operands.front().operands.front();
      definition.value = std::move(inside);
    }
  }
}

}  // namespace veritrack::certificates::language
