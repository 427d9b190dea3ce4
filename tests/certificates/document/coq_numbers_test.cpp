#include "certificates/document/coq_numbers.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::certificates {
namespace {

/// What a term of the form that exactly() writes is, when its parts are doubles.
double value_of(const std::string& term) {
  const bool negative = term.find("(- ") != std::string::npos;
  const double significand = std::strtod(term.c_str() + term.find_first_of("0123456789"), nullptr);
  double power = 0.0;
  if (const auto caret = term.find("2 ^ "); caret != std::string::npos) {
    power = std::strtod(term.c_str() + caret + 4, nullptr);
    power = term.find(" / ") != std::string::npos ? -power : power;
  }
  return std::ldexp(negative ? -significand : significand, static_cast<int>(power));
}

// That Coq takes the two for the same number, tests/cli/proofs_test.py shows.
TEST_CASE("a decimal of Coq's and a fraction have the same digits, one of them after the point at least") {
  const auto both = [](const char* text) { return coq::literal(text) + " " + coq::fraction(text); };
  CHECK(both("0.0023") == "0.0023 (23 # 10000)");
  CHECK(both("-0.50") == "(-0.5) (-5 # 10)");
  CHECK(both("0.0") == "0.0 (0 # 10)");
  CHECK(both("-0") == "0.0 (0 # 10)");
  CHECK(both("1") == "1.0 (10 # 10)");
  CHECK(both("12.5") == "12.5 (125 # 10)");
  CHECK(both("2.5e3") == "2500.0 (25000 # 10)");
  CHECK(both("1_000.0e-4") == "0.1 (1 # 10)");
  CHECK(both("1.25e-7") == "0.000000125 (125 # 1000000000)");
  CHECK_THROWS_AS((void)coq::literal("1) . Abort. ("), rigor::NumberFormatError);
  CHECK_THROWS_AS((void)coq::fraction("nan"), rigor::NumberFormatError);
}

TEST_CASE("decimals become the fractions they are") {
  CHECK(coq::decimal("0.0023") == "(23 / 10000)");
  CHECK(coq::decimal("-1.50") == "(- (15 / 10))");
  CHECK(coq::decimal("+7") == "7");
  CHECK(coq::decimal("1_000.0") == "1000");
  CHECK(coq::decimal("100") == "100");
  CHECK(coq::decimal("0.0") == "0");
  CHECK(coq::decimal("2.5e3") == "(25 * 100)");
  CHECK(coq::decimal("3E+2") == "(3 * 100)");
  CHECK(coq::decimal("1.25e-40") == "(125 / 10 ^ 42)");
  CHECK(coq::decimal("0e5") == "0");
  for (const char* text : {"", "x", "0x10", "1e", "inf", "nan", "1) . Abort. (", "1.0 "}) {
    CAPTURE(text);
    CHECK_THROWS_AS((void)coq::decimal(text), rigor::NumberFormatError);
  }
}

TEST_CASE("doubles become exactly what they are") {
  CHECK(coq::exactly(0.0) == "0");
  CHECK(coq::exactly(-0.0) == "0");
  CHECK(coq::exactly(3.0) == "3");
  CHECK(coq::exactly(-0.75) == "(- (3 / 2 ^ 2))");
  CHECK(coq::exactly(40.0) == "(5 * 2 ^ 3)");
  CHECK(coq::exactly(0x1p-1074) == "(1 / 2 ^ 1074)");
  CHECK_THROWS_AS((void)coq::exactly(std::numeric_limits<double>::infinity()), std::invalid_argument);
  CHECK_THROWS_AS((void)coq::exactly(std::nan("")), std::invalid_argument);
  test::Random random;
  for (std::int64_t i = 0; i < test::effort(2000); ++i) {
    const double value = std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.below(600)) - 300);
    CHECK(value_of(coq::exactly(value)) == value);
  }
}

TEST_CASE("enclosures are those that a certificate prints, outward") {
  const rigor::UpwardRounding upward;
  CHECK(coq::encloses(rigor::Interval::from_bounds(0.5, 2.0), "x") == "(5 / 10) <= x <= 2");
  const rigor::Interval third = rigor::Interval(1.0) / rigor::Interval(3.0);
  CHECK(coq::encloses(third, "third") ==
        "(33333333333333331 / 100000000000000000) <= third <= (33333333333333338 / 100000000000000000)");
}

}  // namespace
}  // namespace veritrack::certificates
