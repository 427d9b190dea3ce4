#include "certificates/model/language/written_out.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/model/language/compiler.hpp"

namespace veritrack::certificates::language {
namespace {

/// The value of a formula of x and y.
double value_of(const std::string& text, double x, double y) {
  const rigor::UpwardRounding upward;
  const Expression formula = parse_expression({text, {1, 1}});
  const Constants constants = collect_constants({}, {&formula});
  const CompiledProgram compiled = compile_formulas({&formula}, constants, {"x", "y"});
  std::vector<double> inputs;
  for (const Constant& constant : constants) {
    inputs.push_back(constant.nearest);
  }
  inputs.insert(inputs.end(), {x, y});
  const rigor::NearestRounding nearest;
  std::vector<double> registers;
  double result = 0.0;
  compiled.program.run(std::span<const double>(inputs), registers, std::span(&result, 1));
  return result;
}

TEST_CASE("functions that stand for a formula have the values of the library's") {
  for (const double x : {-7.0, -3.2, -0.1, 0.0, 0.4, 3.1, 9.5}) {
    for (const double y : {-2.0, 0.3, 4.0}) {
      CHECK(value_of("hypot(x, y)", x, y) == doctest::Approx(std::hypot(x, y)).epsilon(1e-14));
    }
    CHECK(value_of("tanh(x)", x, 0.0) == doctest::Approx(std::tanh(x)).epsilon(1e-13));
    CHECK(value_of("wrap(x)", x, 0.0) ==
          doctest::Approx(std::remainder(x, 2.0 * std::acos(-1.0))).epsilon(1e-13));
  }
  CHECK(value_of("2*wrap(x + 1) - hypot(3, 4)", 0.5, 0.0) == doctest::Approx(-2.0));
}

TEST_CASE("another number of arguments is refused, and a formula that grows without end") {
  const auto message_of = [](const std::string& text) {
    try {
      const rigor::UpwardRounding upward;
      const Expression formula = parse_expression({text, {3, 5}});
      (void)compile_formulas({&formula}, collect_constants({}, {&formula}), {"x", "y"});
      return std::string("nothing");
    } catch (const LanguageError& error) {
      CHECK(error.position().line == 3);
      return std::string(error.what());
    }
  };
  CHECK(message_of("hypot(x)") == "hypot has 1 arguments; allowed: 2");
  CHECK(message_of("wrap(x, y)") == "wrap has 2 arguments; allowed: 1");
  std::string nested = "x";
  for (int i = 0; i < 30; ++i) {
    nested = "wrap(" + nested + ")";
  }
  CHECK(message_of(nested).find("too long") != std::string::npos);
}

TEST_CASE("a wrap around the whole next value of an angle is left out, unless a formula uses that value") {
  const auto is_wrapped = [](const std::string& step) {
    std::vector<Definition> lines = parse_definitions({step, {1, 1}});
    leave_out_outer_wraps(lines, {"x"});
    return lines.front().value.is_wrap;
  };
  CHECK_FALSE(is_wrapped("x' = wrap(x + y)\ny' = y"));
  CHECK_FALSE(is_wrapped("x' = wrap(wrap(x))\ny' = y"));
  CHECK(is_wrapped("x' = wrap(x)\ny' = y + x'"));
  CHECK(is_wrapped("y' = wrap(y)\nx' = x"));
  CHECK(is_wrapped("x = wrap(y)\nx' = x"));
}

}  // namespace
}  // namespace veritrack::certificates::language
