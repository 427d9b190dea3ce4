#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <string>

#include "certificates/model/language/expression.hpp"

namespace veritrack::certificates::language {
namespace {

/// The tree with a pair of parentheses for each operation.
std::string tree(const Expression& expression) {
  constexpr std::array kNames{"", "", "minus", "+", "-", "*", "/", "^", "", ""};
  if (expression.operands.empty()) {
    return expression.text;
  }
  std::string text = "(" + std::string(kNames[static_cast<std::size_t>(expression.kind)]) + expression.text;
  for (const Expression& operand : expression.operands) {
    text += " " + tree(operand);
  }
  return text + (expression.kind == Expression::Kind::power ? fmt::format(" {})", expression.exponent) : ")");
}

std::string message(const auto& parse, const std::string& text, Position position = {1, 1}) {
  try {
    (void)parse({text, position});
  } catch (const LanguageError& error) {
    return fmt::format("{}:{}: {}", error.position().line, error.position().column, error.what());
  }
  return "no error";
}

TEST_CASE("operators bind as in C, a power before a sign") {
  const auto is = [](const char* text, const char* expected) {
    CHECK(tree(parse_expression({text, {1, 1}})) == expected);
  };
  is("a + b * c - d", "(- (+ a (* b c)) d)");
  is("a/b/c*d", "(* (/ (/ a b) c) d)");
  is("-x^2", "(minus (^ x 2))");
  is("2*-y", "(* 2 (minus y))");
  is("--x", "(minus (minus x))");
  is("(a + b)*c", "(* (+ a b) c)");
  is("f(g(x), 2e5*e/h) - .5", "(- (f (g x) (/ (* 2e5 e) h)) .5)");
  is("sin (x)", "(sin x)");
  is("alpha'^2 + P.x1.x1", "(+ (^ alpha' 2) P.x1.x1)");
  is(" ( a\n + # first\n b )", "(+ a b)");
  is("1.5e-3", "1.5e-3");
}

TEST_CASE("a condition compares two formulas, as the first argument of if") {
  const auto is = [](const char* text, const char* expected) {
    CHECK(tree(parse_expression({text, {1, 1}})) == expected);
  };
  is("if(x + 1 < 2*y, a, b)", "(if (< (+ x 1) (* 2 y)) a b)");
  is("1 + if(-x>=y^2, if(a <= 0, 1, 2), b - c)",
     "(+ 1 (if (>= (minus x) (^ y 2)) (if (<= a 0) 1 2) (- b c)))");
  is("if ( x # why\n > 0 , a,\n b )", "(if (> x 0) a b)");
}

TEST_CASE("a condition in the manner of another language is told what to write in its place") {
  for (const char* text : {"x > 0 ? a : b", "(x < 0)*a", "if x > 0", "a if b else c", "x && y",
                           "if(x > 0 && y, a, b)", "if(a < b < c, 1, 0)", "if(x > 0 then a else b)"}) {
    CAPTURE(text);
    CHECK(message(parse_expression, text)
              .find("a condition is written if(x > y, a, b), which is a where x > y") != std::string::npos);
  }
  for (const char* text : {"x == 2", "if(x == 2, a, b)", "if(x != 2, a, b)"}) {
    CAPTURE(text);
    CHECK(message(parse_expression, text).find("write x < y, x <= y, x > y or x >= y") != std::string::npos);
  }
  CHECK(message(parse_definitions, "a = b\nw' = if a > 0 then a else b").find("if(x > y, a, b)") !=
        std::string::npos);
  for (const char* text : {"x $ 2", "gif 2", "2 +", "x y"}) {
    CAPTURE(text);
    CHECK(message(parse_expression, text).find("if(x > y") == std::string::npos);
  }
}

TEST_CASE("what is no formula is told with its place") {
  const auto is = [](const std::string& text, const char* expected) {
    CHECK(message(parse_expression, text) == expected);
  };
  is("", "1:1: the text ends; allowed: a number, a name, a function, a minus sign or (");
  is("a b", "1:3: found \"b\"; allowed: an operator, or the end of the formula");
  is("2e", "1:2: found \"e\"; allowed: an operator, or the end of the formula");
  is("x^2^3", "1:4: found \"^3\"; allowed: an operator, or the end of the formula");
  is("x^-1", "1:3: found \"-1\"; allowed: a whole exponent, 1 or more (otherwise sqrt, or exp and log)");
  is("x^0", "1:3: the exponent 0 is too small; allowed: 1 to 16");
  is("x^99", "1:3: the exponent 99 is too large; allowed: 1 to 16");
  is("x^99999999999", "1:3: the exponent 99999999999 is too large; allowed: 1 to 16");
  is("1/(2", "1:5: the text ends; allowed: an operator or ) (or a comma in a function)");
  is("(a\n  b)", "2:3: found \"b)\"; allowed: an operator or ) (or a comma in a function)");
  is("a = b", "1:3: found \"= b\"; allowed: an operator, or the end of the formula");
  is(std::string(70, '-') + "x",
     "1:65: parentheses and signs more than 64 deep; allowed: a name for a part of the formula, on a line of "
     "its "
     "own");
  is(std::string(100000, '('),
     "1:65: parentheses and signs more than 64 deep; allowed: a name for a part of the formula, on a line of "
     "its "
     "own");
}

TEST_CASE("long formulas are read, endless ones refused") {
  std::string text = "x";
  for (int i = 0; i < 900; ++i) {
    text += " + x";
  }
  CHECK(parse_expression({text, {1, 1}}).depth == 901);
  for (int i = 0; i < 100000; ++i) {
    text += "+x";
  }
  CHECK(message(parse_expression, text).find("more than 1000 operations one inside the other") !=
        std::string::npos);
}

TEST_CASE("a step is a definition a line, with comments, empty lines and open parentheses") {
  const std::vector<Definition> definitions =
      parse_definitions({"# the error\n"
                         "e      = y - alpha   # of this sample\n"
                         "\n"
                         "alpha' = alpha + w*T*(k*e -\n"
                         "                      beta)\r\n"
                         "  w'   = w",
                         {10, 1}});
  REQUIRE(definitions.size() == 3);
  CHECK(definitions[0].name == "e");
  CHECK(definitions[0].position.line == 11);
  CHECK(definitions[1].name == "alpha'");
  CHECK(tree(definitions[1].value) == "(+ alpha (* (* w T) (- (* k e) beta)))");
  CHECK(definitions[2].position.line == 15);
  CHECK(definitions[2].position.column == 3);
  CHECK(parse_definitions({"", {1, 1}}).empty());
}

TEST_CASE("what is no definition is told with its place in the file") {
  const auto is = [](const char* text, const char* expected) {
    CHECK(message(parse_definitions, text, {7, 9}) == expected);
  };
  is("x' = ", "7:14: the text ends; allowed: a number, a name, a function, a minus sign or (");
  is("x 3", "7:11: found \"3\"; allowed: = behind the name that is defined");
  is("\n= 4", "8:1: found \"= 4\"; allowed: a definition: name = formula, or state' = formula");
  is("x = 3 y = 4", "7:15: found \"y = 4\"; allowed: an operator, or the end of the line");
  is("x = 2 +\n3", "7:16: the line ends; allowed: a number, a name, a function, a minus sign or (");
}

}  // namespace
}  // namespace veritrack::certificates::language
