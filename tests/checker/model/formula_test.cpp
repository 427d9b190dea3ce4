// The checker's reader of formulas against the program's: two grammars, two arithmetics.
#include "checker/model/formula.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/model/language/compiler.hpp"
#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

namespace language = certificates::language;
using test::effort;

const std::vector<std::string> kNames{"x", "y", "P.x.w", "a_2"};
const std::vector<double> kValues{0.7, -1.25, 2.5, 0.125};

const std::vector<std::string> kFunctions{"sqrt", "exp",  "log",   "sin",          "cos",   "tan",  "asin",
                                          "acos", "atan", "atan2", "stays_within", "hypot", "tanh", "wrap",
                                          "min",  "max",  "abs",   "sign",         "clamp", "if"};

/// A call, mostly with an argument for which it is defined.
std::string random_call(test::Random& random, const std::string& argument) {
  const bool as_it_comes = random.below(4) == 0;
  const std::string& name = kFunctions[random.below(kFunctions.size())];
  if (name == "atan2") {
    return "atan2(" + argument + ", # why\n" + (as_it_comes ? "x*y" : "1 + x^2") + ")";
  }
  if (name == "hypot") {
    return "hypot(" + argument + ", 0.5)";
  }
  if (name == "stays_within") {
    return "stays_within(" + argument + ", -1000, 1000)";
  }
  if (name == "min" || name == "max") {
    return name + "(" + argument + ", " + (as_it_comes ? "0.5*(" + argument + ")" : "x*y") + ")";
  }
  if (name == "clamp") {
    return "clamp(" + argument + ", " + (as_it_comes ? "x, a_2" : "y, x") + ")";
  }
  if (name == "if") {
    const std::vector<std::string> signs{" < ", "<=", " >", ">= "};
    return "if(" + argument + signs[random.below(signs.size())] + "x - 1, 2*y, " + argument + ")";
  }
  if (as_it_comes) {
    return name + "( " + argument + " )";
  }
  if (name == "sqrt" || name == "log") {
    return name + "(0.5 + (" + argument + ")^2)";
  }
  return name + (name == "asin" || name == "acos" || name == "exp" || name == "tanh"
                     ? "(0.9*sin(" + argument + "))"
                     : "(" + argument + ")");
}

/// A formula of random shape; blanks, comments and line ends only where the grammar allows them.
std::string random_formula(test::Random& random, int depth) {
  const auto part = [&] { return random_formula(random, depth - 1); };
  switch (depth <= 0 ? random.below(3) : random.below(13)) {
    case 0:
      return kNames[random.below(kNames.size())];
    case 1:
      return std::to_string(random.below(9)) +
             (random.below(2) == 0 ? "." + std::to_string(random.below(99)) : "");
    case 2:
      return "2.5e-1";
    case 3:
      return part() + " + " + part();
    case 4:
      return part() + "-" + part();
    case 5:
      return part() + "*" + part();
    case 6:
      return part() + " /" + part();
    case 7:
      return "-" + part();
    case 8:
      return "(" + part() + "\n )^" + std::to_string(1 + random.below(4));
    case 9:
    case 10:
    case 11:
      return random_call(random, part());
    default:
      return "(" + part() + ")";
  }
}

/// The program's value; empty when it is undefined.
rigor::Interval program_value(const std::string& text) {
  const rigor::UpwardRounding scope;
  const language::Expression formula = language::parse_expression({text, {1, 1}});
  const language::Constants constants = language::collect_constants({}, {&formula});
  const language::CompiledProgram compiled = language::compile_formulas({&formula}, constants, kNames);
  std::vector<rigor::Interval> inputs;
  for (const language::Constant& constant : constants) {
    inputs.push_back(constant.value);
  }
  for (const double value : kValues) {
    inputs.emplace_back(value);
  }
  std::vector<rigor::Interval> registers;
  rigor::Interval result;
  compiled.program.run(std::span<const rigor::Interval>(inputs), registers, std::span(&result, 1));
  return result;
}

Ball checker_value(const std::string& text) {
  return value_of<Ball>(read_formula(text), [](const FormulaStep& leaf) {
    if (leaf.kind == FormulaStep::Kind::number) {
      return from_decimal(leaf.text);
    }
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      if (kNames[i] == leaf.text) {
        return Ball(kValues[i]);
      }
    }
    throw FormulaError("unknown name " + leaf.text);
  });
}

TEST_CASE("both readers give random formulas the same value") {
  test::Random random(41);
  int finite = 0;
  std::map<std::string, int> compared;  // calls of each function
  for (std::int64_t round = effort(3000); round > 0; --round) {
    const std::string text = random_formula(random, 4);
    const rigor::Interval program = program_value(text);
    const Ball checker = checker_value(text);
    if (!rigor::is_finite(program) || !checker.finite()) {
      continue;
    }
    ++finite;
    const Ball low(program.lower());
    const Ball high(program.upper());
    const bool apart = certainly_less(checker, low) || certainly_less(high, checker);
    // Wide intervals say little: most are as narrow as rounding.
    CHECK_MESSAGE(!apart, text);
    for (const std::string& name : kFunctions) {
      compared[name] += text.find(name + "(") != std::string::npos ? 1 : 0;
    }
  }
  CHECK(finite > effort(3000) / 2);
  for (const std::string& name : kFunctions) {
    CAPTURE(name);
    CHECK(compared[name] > finite / 50);
  }
}

/// What the program's grammar leaves to its compiler: conditions elsewhere than in if, and too many
/// arguments.
bool is_left_to_compiler(const language::Expression& formula, bool may_compare = false) {
  using Kind = language::Expression::Kind;
  bool is_left = (formula.kind == Kind::comparison && !may_compare) || formula.operands.size() > 3;
  for (std::size_t i = 0; i < formula.operands.size(); ++i) {
    const bool is_condition = formula.kind == Kind::call && formula.text == "if" && i == 0;
    is_left = is_left || is_left_to_compiler(formula.operands[i], is_condition);
  }
  return is_left;
}

TEST_CASE("both readers accept and refuse the same texts") {
  test::Random random(42);
  const std::string letters = "x1.+-*/^()', \n#eP<>=";
  int refused = 0;
  for (std::int64_t round = effort(6000); round > 0; --round) {
    std::string text = random_formula(random, 2);
    for (std::uint64_t change = random.below(3); change > 0; --change) {
      const std::size_t place = random.below(text.size());
      text[place] = letters[random.below(letters.size())];
    }
    bool program_reads = true;
    bool checker_reads = true;
    try {
      program_reads = !is_left_to_compiler(language::parse_expression({text, {1, 1}}));
    } catch (const language::LanguageError&) {
      program_reads = false;
      ++refused;
    }
    try {
      (void)read_formula(text);
    } catch (const FormulaError&) {
      checker_reads = false;
    }
    CHECK_MESSAGE(program_reads == checker_reads, text);
  }
  CHECK(refused > effort(6000) / 10);
}

TEST_CASE("functions with kinks and conditions have the values of their names") {
  const auto is = [](const std::string& text, double expected) {
    CAPTURE(text);
    const Ball value = checker_value(text);
    CHECK(certainly_equal(value, Ball(expected)));
    const rigor::Interval program = program_value(text);
    CHECK(program.lower() == expected);
    CHECK(program.upper() == expected);
  };
  is("min(2, 3) + 10*max(2, 3)", 32);
  is("abs(2 - 3) - abs(7)", -6);
  is("sign(-2) + 10*sign(3)", 9);
  is("clamp(5, 1, 2) + 10*clamp(-5, 1, 2) + 100*clamp(1.5, 1, 2)", 162);
  is("if(1 < 2, 3, 4) + 10*if(1 > 2, 3, 4) + 100*if(2 <= 2, 3, 4) + 1000*if(2 >= 3, 3, 4)", 4343);
  is("if(2 < 2, 3, 4) + 10*if(2 > 2, 3, 4) + 100*if(2 >= 2, 3, 4)", 344);
  is("if(1 + 1 < 2*3 - 1, if(3 > 2, 5, 6), log(-1))", 5);
  for (const char* text : {"sign(x - x)", "clamp(1, 2, 1)", "if(x < y, log(-1), 1 - 1) + log(0 - 1)"}) {
    CAPTURE(text);
    CHECK_FALSE(checker_value(text).finite());
    CHECK_FALSE(rigor::is_finite(program_value(text)));
  }
}

TEST_CASE("a choice whose condition is not certain has no value") {
  const auto is = [](const Ball& chosen_one, const Ball& value) {
    return certainly_equal(chosen_one, value);
  };
  CHECK(is(chosen(half, one, two), one));
  CHECK(is(chosen(zero, one, two), two));
  CHECK(is(chosen(-half, one, two), two));
  CHECK(is(chosen(Ball::hull(-two, -half), one, two), two));
  CHECK_FALSE(chosen(Ball::hull(-one, one), one, two).finite());
  CHECK_FALSE(chosen(Ball::hull(zero, one), one, two).finite());
  CHECK_FALSE(chosen(Ball::everything(), one, two).finite());
}

TEST_CASE("both readers accept and refuse the same steps") {
  const std::vector<std::string> texts{
      "",
      "# nothing\n\n",
      "x' = x + y",
      "x' = x +\n y",
      "x' = (x +\n y)\r\ne = y # end",
      "a = 1\n\n  b = a",
      "a = 1 b = 2",
      "a 1",
      "= 3",
      "a = ",
      "a == 1",
      "P.x.y' = 3",
      "1 = a",
      "a = (1",
      "a = 1)",
      "a = f(1, 2)\n",
      "a = f(1,)\n",
      "a = f()\n",
      "a = 1,2\n",
      "a = x''\n",
  };
  for (const std::string& text : texts) {
    CAPTURE(text);
    std::size_t program_lines = 0;
    std::size_t checker_lines = 0;
    bool program_reads = true;
    bool checker_reads = true;
    try {
      program_lines = language::parse_definitions({text, {1, 1}}).size();
    } catch (const language::LanguageError&) {
      program_reads = false;
    }
    try {
      checker_lines = read_lines(text).size();
    } catch (const FormulaError&) {
      checker_reads = false;
    }
    CHECK(program_reads == checker_reads);
    CHECK(program_lines == checker_lines);
  }
}

TEST_CASE("no input exhausts the memory for calls") {
  CHECK_NOTHROW((void)read_formula(std::string(40000, '-') + "x"));
  CHECK_NOTHROW((void)read_formula(std::string(40000, '(') + "x" + std::string(40000, ')')));
  CHECK_THROWS_AS((void)read_formula(std::string(40000, '(') + "x"), FormulaError);
  std::string sum = "x";
  for (int i = 0; i < 200000; ++i) {
    sum += "+x";
  }
  CHECK_THROWS_AS((void)read_formula(sum), FormulaError);
}

TEST_CASE("lines are put in an order in which each can be computed") {
  const std::vector<FormulaLine> ordered =
      in_order_of_need(read_lines("s' = a - t'\na = k + b\nt' = 1\nb = 2"));
  REQUIRE(ordered.size() == 4);
  CHECK(ordered[0].name == "t'");
  CHECK(ordered[3].name == "s'");
  CHECK_THROWS_AS((void)in_order_of_need(read_lines("a = b\nb = a")), FormulaError);
  CHECK_THROWS_AS((void)in_order_of_need(read_lines("a = 1\na = 2")), FormulaError);
}

TEST_CASE("what is not known of a limit is not known of the value") {
  CHECK_FALSE(stays_within(Ball(2.0), Ball(0.0), Ball(1.0)).finite());
  CHECK_FALSE(stays_within(Ball(1.0), Ball(0.0), Ball(1.0)).finite());
  CHECK(stays_within(Ball(0.5), Ball(0.0), Ball(1.0)).finite());
  CHECK_THROWS_AS((void)checker_value("max(1)"), FormulaError);
  CHECK_THROWS_AS((void)checker_value("if(1, 2, 3)"), FormulaError);
  CHECK_THROWS_AS((void)checker_value("if(1 < 2, 3)"), FormulaError);
  CHECK_THROWS_AS((void)checker_value("if(1 < 2 < 3, 3, 4)"), FormulaError);
  CHECK_THROWS_AS((void)checker_value("if(1, 2 < 3, 4)"), FormulaError);
  CHECK_THROWS_AS((void)checker_value("abs(1 < 2)"), FormulaError);
  CHECK_THROWS_AS((void)checker_value("if((1 < 2), 3, 4)"), FormulaError);
  CHECK_THROWS_AS((void)checker_value("sin(1, 2)"), FormulaError);
}

}  // namespace
}  // namespace veritrack::checker
