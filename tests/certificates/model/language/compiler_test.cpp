#include "certificates/model/language/compiler.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/piecewise.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::certificates::language {
namespace {

Expression formula(const char* text) {
  return parse_expression({text, {1, 1}});
}

/// A step over the states s, t and the sample y, with the parameter k.
CompiledProgram step(const std::string& text) {
  const rigor::UpwardRounding scope;
  const std::vector<Definition> definitions = parse_definitions({text, {1, 1}});
  std::vector<const Expression*> formulas;
  formulas.reserve(definitions.size());
  for (const Definition& definition : definitions) {
    formulas.push_back(&definition.value);
  }
  return compile_step(definitions, collect_constants({{"k", {1, 1}, formula("3")}}, formulas), {"s", "t"},
                      {"y"}, {9, 9});
}

std::string message(const std::string& text) {
  try {
    (void)step(text);
  } catch (const LanguageError& error) {
    return fmt::format("{}:{}: {}", error.position().line, error.position().column, error.what());
  }
  return "no error";
}

TEST_CASE("a program computes what the formulas say, in any order of the lines") {
  const CompiledProgram compiled =
      step("s' = a - t'\na = k*y + sin(s)/2\nt' = t^3 + stays_within(y, -k, k)\n");
  const std::vector<double> inputs{3.0, 2.0, 0.7, 1.5, 0.25};  // k, 2, s, t, y
  std::vector<double> registers;
  std::vector<double> next(2);
  compiled.program.run(std::span<const double>(inputs), registers, std::span(next));
  CHECK(next[1] == 1.5 * 1.5 * 1.5 + 0.25);
  CHECK(next[0] == 3.0 * 0.25 + std::sin(0.7) / 2.0 - next[1]);
  CHECK(compiled.positions.size() == compiled.program.instructions().size());
}

TEST_CASE("what is written twice is computed once") {
  const CompiledProgram compiled = step("s' = sin(s + t) + cos(s + t)\nt' = sin(s + t)");
  CHECK(compiled.program.instructions().size() == 4);  // s + t, sin, cos, sum
}

TEST_CASE("nothing is simplified") {
  CHECK(step("s' = s/s\nt' = 0*t + y - y").program.instructions().size() == 4);
}

TEST_CASE("parameters are enclosed, and computed as they are written") {
  const rigor::UpwardRounding scope;
  const Expression use = formula("k*T + 2*pi");
  const Constants constants = collect_constants({{"k", {1, 1}, formula("0.1")},
                                                 {"T", {2, 1}, formula("1/10000")},
                                                 {"c", {3, 1}, formula("k*T + sqrt(2)")}},
                                                {&use});
  REQUIRE(constants.size() == 5);
  CHECK(constants[0].value.lower() < constants[0].value.upper());
  CHECK(constants[0].nearest == 0.1);
  CHECK(constants[2].name == "c");
  CHECK(std::abs(constants[2].nearest - (1e-5 + std::sqrt(2.0))) < 1e-15);
  CHECK(contains(constants[2].value, constants[2].nearest));
  CHECK(constants[3].name == "2");
  CHECK(constants[3].value.lower() == constants[3].value.upper());
  CHECK(constants[4].name == "pi");
  CHECK(constants[4].nearest == std::acos(-1.0));
  const auto refused = [](const char* text) {
    const rigor::UpwardRounding scope_of_it;
    (void)collect_constants({{"k", {1, 1}, formula(text)}}, {});
  };
  CHECK_THROWS_WITH_AS(refused("1/0"), "the value of k is undefined, or not finite", LanguageError);
  CHECK_THROWS_WITH_AS(refused("asin(2)"), "the value of k is undefined, or not finite", LanguageError);
  CHECK_THROWS_WITH_AS(refused("1e999"), "1e999 is not a number in the range of double precision",
                       LanguageError);
  CHECK_THROWS_WITH_AS(refused("k"), "unknown name k; allowed: numbers", LanguageError);
}

TEST_CASE("functions with kinks and jumps are those of their names, at and off the kink") {
  const auto value = [](const std::string& text, double s, double t) {
    const rigor::UpwardRounding scope;
    const CompiledProgram compiled = step("s' = " + text + "\nt' = t");
    const auto constants = static_cast<std::size_t>(compiled.program.inputs()) - 3;
    std::vector<double> inputs{3.0};
    for (std::size_t i = 1; i < constants; ++i) {
      inputs.push_back(static_cast<double>(i));  // literals are written in this order
    }
    inputs.insert(inputs.end(), {s, t, 0.0});
    std::vector<double> registers;
    std::vector<double> results(2);
    compiled.program.run(std::span<const double>(inputs), registers, std::span(results));
    return results[0];
  };
  for (const double s : {-2.5, -1.0, -0.0, 0.0, 0.5, 1.0, 2.0, 7.0}) {
    for (const double t : {-1.0, 0.0, 1.0, 2.0}) {
      CAPTURE(s);
      CAPTURE(t);
      CHECK(value("min(s, t)", s, t) == std::min(s, t));
      CHECK(value("max(s, t)", s, t) == std::max(s, t));
      CHECK(value("abs(s - t)", s, t) == std::abs(s - t));
      CHECK(value("sign(s)", s, t) == (s > 0 ? 1 : s < 0 ? -1 : 0));
      CHECK(value("clamp(s, 1, 2)", s, t) == std::clamp(s, 1.0, 2.0));
      CHECK(value("if(s < t, 1, 2)", s, t) == (s < t ? 1 : 2));
      CHECK(value("if(s <= t, 1, 2)", s, t) == (s <= t ? 1 : 2));
      CHECK(value("if(s > t, 1, 2)", s, t) == (s > t ? 1 : 2));
      CHECK(value("if(s >= t, 1, 2)", s, t) == (s >= t ? 1 : 2));
    }
  }
  // Operations of the branch that is not taken need not be defined.
  CHECK(value("if(t > s, log(s), 1)", -1.0, -2.0) == 1.0);
}

TEST_CASE("a line that nothing needs is an error, and a limit has to be shown wherever it stands") {
  CHECK(
      message("s' = s\nu = log(-1 - s)\nt' = t") ==
      "2:1: u is unused: delete it, or it is part of what runs; allowed: lines that a next value needs, and "
      "limits, name = stays_within(...)");
  CHECK(message("s' = s\nt' = t\nu = s\nv = 2*u").starts_with("4:1: v is unused"));
  CHECK(message("s' = s\nt' = t\nv = 2*stays_within(s, 0, 1)").starts_with("3:1: v is unused"));
  const CompiledProgram compiled =
      step("s' = s\nt' = t\nu = t - k\nguard = stays_within(s, 2, 4)\nother = stays_within(u, -1, k)");
  REQUIRE(compiled.program.limits().size() == 2);
  const auto next = [&](double s, double t) {
    const rigor::UpwardRounding scope;
    // k, the literals 2, 4 and 1, s, t, y
    std::vector<rigor::Interval> inputs;
    for (const double input : {3.0, 2.0, 4.0, 1.0, s, t, 0.0}) {
      inputs.emplace_back(input);
    }
    std::vector<rigor::Interval> registers;
    std::vector<rigor::Interval> results(2);
    compiled.program.run(std::span<const rigor::Interval>(inputs), registers, std::span(results));
    return results[0];
  };
  CHECK(next(3.0, 3.5).lower() == 3.0);
  CHECK(next(3.0, 3.5).upper() == 3.0);
  CHECK(is_empty(next(1.0, 3.5)));
  CHECK(is_empty(next(3.0, 7.0)));
  CHECK(is_empty(next(3.0, 1.5)));
  // Numbers are as they are.
  const std::vector<double> inputs{3.0, 2.0, 4.0, 1.0, 9.0, 9.0, 0.0};
  std::vector<double> registers;
  std::vector<double> results(2);
  compiled.program.run(std::span<const double>(inputs), registers, std::span(results));
  CHECK(results[0] == 9.0);
}

TEST_CASE("what cannot be understood is told with its place and with what is allowed") {
  CHECK(message("s' = sigma + 1\nt' = t") ==
        "1:6: unknown name sigma; nearest known name: s; allowed: k, s, t, y");
  CHECK(message("s' = phi\nt' = t") ==
        "1:6: phi is the phase of the tone, which cannot be used here; allowed: k, s, "
        "t, y");
  CHECK(message("s' = sin\nt' = t") == "1:6: sin is a function; allowed: sin(...)");
  CHECK(message("s' = s\n") == "9:9: the state t has no next value; allowed: a line t' = ...");
  CHECK(message("s' = s\nt' = t\ns' = 2") ==
        "3:1: s' is defined a second time; allowed: one definition of each name");
  CHECK(message("s' = a\na = b + t'\nb = 2*a\nt' = t") ==
        "2:1: a circle of definitions: a needs b needs a; allowed: formulas that end at states, samples and "
        "parameters");
  CHECK(message("s' = s\nt' = t\ny = 3") ==
        "3:1: y is a state, a sample or a parameter; allowed: a name of its own, or the next value of a "
        "state, with "
        "a prime");
  CHECK(message("s' = s\nt' = t\nu' = 3") ==
        "3:1: u' is no next value of a state; nearest state: s; allowed: s, t");
  CHECK(message("s' = s\nt' = t\npi = 3") == "3:1: pi is the circle constant; allowed: another name");
  CHECK(message("s' = atan2(s)\nt' = t") == "1:6: atan2 has 1 arguments; allowed: 2");
  CHECK(message("s' = max(s)\nt' = t") == "1:6: max has 1 arguments; allowed: 2");
  CHECK(message("s' = sgn(s)\nt' = t") ==
        "1:6: unknown function sgn; allowed: sign(x), which is 1, -1, or 0 at 0");
  CHECK(message("s' = floor(s)\nt' = t").starts_with("1:6: floor rounds, which cannot be certified"));
  CHECK(message("s' = if(s, s, t)\nt' = t") ==
        "1:9: the first argument of if is no condition; allowed: x < y, x <= y, x > y, x >= y");
  CHECK(message("s' = if(s < t, s > t, t)\nt' = t") ==
        "1:16: a condition with > that is no first argument of if; allowed: if(x > y, a, b)");
  CHECK(message("s' = sqrt(s < t)\nt' = t").starts_with("1:11: a condition with < that is no first"));
  CHECK(message("s' = wrap(s < t)\nt' = t").starts_with("1:11: a condition with < that is no first"));
  CHECK(message("s' = s\nt' = t\nmin = s").starts_with("3:1: min is a function"));
  CHECK(
      message("s' = sine(s)\nt' = t").starts_with("1:6: unknown function sine; nearest: sin; allowed: sqrt"));
  CHECK(message("s' = pow(s, 2)\nt' = t").starts_with("1:6: pow is unknown; allowed: x^n"));
}

}  // namespace
}  // namespace veritrack::certificates::language
