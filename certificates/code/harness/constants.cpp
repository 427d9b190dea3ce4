#include "certificates/code/harness/constants.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace veritrack::certificates::code {

namespace {

constexpr int kMostDepth = 60;

std::optional<double> result_of(const std::string& operation, double a, double b) {
  if (operation == "+") {
    return a + b;
  }
  if (operation == "-") {
    return a - b;
  }
  if (operation == "*") {
    return a * b;
  }
  if (operation == "/" && b != 0.0) {
    return a / b;
  }
  return std::nullopt;
}

std::optional<double> constant_within(const nlohmann::json& expression, int depth) {
  constexpr std::array<std::string_view, 9> kWrappers{
      "ImplicitCastExpr", "CStyleCastExpr",        "ParenExpr",
      "ConstantExpr",     "CXXFunctionalCastExpr", "CXXStaticCastExpr",
      "ExprWithCleanups", "InitListExpr",          "MaterializeTemporaryExpr"};
  const std::string kind = expression.value("kind", "");
  if (kind == "FloatingLiteral" || kind == "IntegerLiteral") {
    return std::strtod(expression.value("value", "0").c_str(), nullptr);
  }
  const auto inner = expression.find("inner");
  if (inner == expression.end() || inner->empty() || depth == 0) {
    return std::nullopt;
  }
  const std::optional<double> first = constant_within(inner->front(), depth - 1);
  if (kind == "UnaryOperator" && first) {
    const std::string operation = expression.value("opcode", "");
    return operation == "-" ? std::optional(-*first) : operation == "+" ? first : std::nullopt;
  }
  if (kind == "BinaryOperator" && inner->size() == 2 && first) {
    const std::optional<double> second = constant_within(inner->back(), depth - 1);
    const bool is_integer = expression.value("/type/qualType"_json_pointer, "") == "int";
    const std::optional<double> value =
        second ? result_of(expression.value("opcode", ""), *first, *second) : std::nullopt;
    return value && is_integer ? std::optional(std::trunc(*value)) : value;
  }
  for (const std::string_view wrapper : kWrappers) {
    if (kind == wrapper && inner->size() == 1) {
      return first;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> constant_value(const nlohmann::json& expression) {
  return constant_within(expression, kMostDepth);
}

}  // namespace veritrack::certificates::code
