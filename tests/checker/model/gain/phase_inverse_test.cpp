#include "checker/model/gain/phase_inverse.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "checker/model/gain/exact_number.hpp"
#include "checker/model/gain/phase_range.hpp"

namespace veritrack::checker {
namespace {

/// A constant up to a share of it that depends on the frequency.
BallPolynomial leaning(double constant, double share) {
  return BallPolynomial::affine(constant, 0.0, share * constant, 0.0);
}

TEST_CASE("a solution is in its range, in any units of rows and columns") {
  // Rows in units of 1e-6 and 1e3, columns in units of 1 and 1e5: 2 x + y = 5, x - 3 y = -1 has (2, 1).
  const PolynomialMatrix matrix{{leaning(2e-6, 1e-3), leaning(1e-1, 1e-3)},
                                {leaning(1e3, 1e-3), leaning(-3e8, 1e-3)}};
  const PolynomialMatrix found = solution_of(matrix, {{BallPolynomial(5e-6)}, {BallPolynomial(-1e3)}});
  const DoubleRange x = range_over_cell(found[0][0]);
  const DoubleRange y = range_over_cell(found[1][0]);
  CHECK(x.low <= 2.0);
  CHECK(x.high >= 2.0);
  CHECK(x.high - x.low < 0.02);
  CHECK(y.low <= 1e-5);
  CHECK(y.high >= 1e-5);
  CHECK(y.high - y.low < 1e-7);
}

TEST_CASE("where each entry of the first column may be 0 another unknown is eliminated first") {
  // s x + y = 1, (s - 1/2) x + y = 2 for all |s| <= 0.9: x = -2, y = 1 + 2 s.
  const PolynomialMatrix matrix{{BallPolynomial::affine(0.0, 0.9, 0.0, 0.0), BallPolynomial(1.0)},
                                {BallPolynomial::affine(-0.5, 0.9, 0.0, 0.0), BallPolynomial(1.0)}};
  const PolynomialMatrix found = solution_of(matrix, {{BallPolynomial(1.0)}, {BallPolynomial(2.0)}});
  CHECK(range_over_cell(found[0][0]).low == doctest::Approx(-2.0));
  CHECK(range_over_cell(found[0][0]).high == doctest::Approx(-2.0));
  CHECK(range_over_cell(found[1][0]).low == doctest::Approx(-0.8));
  CHECK(range_over_cell(found[1][0]).high == doctest::Approx(2.8));
}

TEST_CASE("a matrix that may be singular has no solution") {
  const BallPolynomial s = BallPolynomial::affine(0.0, 1.0, 0.0, 0.0);
  CHECK_THROWS_AS((void)solution_of({{s}}, {{BallPolynomial(1.0)}}), NotCovered);
}

}  // namespace
}  // namespace veritrack::checker
