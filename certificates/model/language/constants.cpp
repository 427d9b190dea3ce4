#include "certificates/model/language/constants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/piecewise.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/model/language/compiler.hpp"

namespace veritrack::certificates::language {

namespace {

constexpr std::size_t kLongestShown = 60;

Constant literal(const Expression& leaf) {
  Constant constant;
  constant.name = leaf.text;
  constant.is_literal = true;
  try {
    constant.value = rigor::parse_decimal(leaf.text);
  } catch (const rigor::NumberFormatError&) {
    throw LanguageError(leaf.position, fmt::format("{} is not a number in the range of double precision",
                                                   printable(leaf.text, kLongestShown)));
  }
  constant.nearest = rigor::nearest_double(leaf.text);
  return constant;
}

/// Adds the literals and pi that the formula uses and that are not there yet.
void add_constants_of(const Expression& formula, Constants& constants) {
  for_each_leaf(formula, [&](const Expression& leaf) {
    const auto known = std::find_if(constants.begin(), constants.end(),
                                    [&](const Constant& constant) { return constant.name == leaf.text; });
    if (known != constants.end()) {
      return;
    }
    if (leaf.kind == Expression::Kind::number) {
      constants.push_back(literal(leaf));
    } else if (leaf.text == "pi") {
      const rigor::Interval value = rigor::pi();
      constants.push_back({"pi", value, std::acos(-1.0), true});
    }
  });
}

/// Both values of a parameter.
Constant evaluate(const NamedFormula& parameter, const Constants& known) {
  const CompiledProgram compiled = compile_formulas({&parameter.formula}, known, {});
  std::vector<rigor::Interval> exact;
  std::vector<double> nearest;
  for (const Constant& constant : known) {
    exact.push_back(constant.value);
    nearest.push_back(constant.nearest);
  }
  Constant result{parameter.name, {}, 0.0, false};
  std::vector<rigor::Interval> interval_registers;
  compiled.program.run(std::span<const rigor::Interval>(exact), interval_registers,
                       std::span(&result.value, 1));
  {
    const rigor::NearestRounding scope;
    std::vector<double> registers;
    compiled.program.run(std::span<const double>(nearest), registers, std::span(&result.nearest, 1));
  }
  if (!rigor::is_finite(result.value) || !std::isfinite(result.nearest)) {
    throw LanguageError(parameter.formula.position,
                        fmt::format("the value of {} is undefined, or not finite", parameter.name));
  }
  result.value = hull(result.value, rigor::Interval(result.nearest));
  return result;
}

}  // namespace

Constants collect_constants(const std::vector<NamedFormula>& parameters,
                            const std::vector<const Expression*>& formulas) {
  Constants constants;
  for (const NamedFormula& parameter : parameters) {
    require_free_name(parameter.name, parameter.position);
    Constants known = constants;
    Constants of_formula;
    add_constants_of(parameter.formula, of_formula);
    known.insert(known.end(), of_formula.begin(), of_formula.end());
    constants.push_back(evaluate(parameter, known));
  }
  for (const Expression* formula : formulas) {
    add_constants_of(*formula, constants);
  }
  return constants;
}

}  // namespace veritrack::certificates::language
