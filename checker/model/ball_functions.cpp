// Elementary functions of ball polynomials: Taylor's polynomial at the constant coefficient, with Lagrange's
// remainder over all values, both from Arb's power series.
#include "checker/model/ball_polynomial.hpp"

#include <arb_poly.h>

#include <array>
#include <cmath>

#include "checker/model/formula.hpp"
#include "checker/model/rounding.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

constexpr std::size_t kTerms = BallPolynomial::kMostDegree + 1;

using ArbSeries = void (*)(arb_poly_struct*, const arb_poly_struct*, slong, slong);

/// f(at + t), the coefficients of t^0 to t^5: enclosures for all points of `at`.
std::array<Ball, kTerms + 1> expansion(ArbSeries series, const Ball& at) {
  spend(static_cast<std::int64_t>(kTerms));
  arb_poly_t argument;
  arb_poly_t value;
  arb_poly_init(argument);
  arb_poly_init(value);
  arb_poly_set_coeff_arb(argument, 0, at.raw());
  arb_poly_set_coeff_si(argument, 1, 1);
  series(value, argument, static_cast<slong>(kTerms + 1), precision());
  std::array<Ball, kTerms + 1> coefficients;
  for (std::size_t k = 0; k <= kTerms; ++k) {
    arb_poly_get_coeff_arb(coefficients[k].raw(), value, static_cast<slong>(k));
  }
  arb_poly_clear(argument);
  arb_poly_clear(value);
  return coefficients;
}

/// sum over k < 5 of f_k x^k, where |x| <= size, and anything within remainder size^5 of it.
BallPolynomial value_of_taylor(const std::array<Ball, kTerms + 1>& f, const BallPolynomial& x, double size,
                               const Ball& remainder) {
  std::array<double, kTerms> near{};
  double error = remainder.upper_double();
  for (std::size_t k = kTerms; k-- > 0;) {
    near[k] = f[k].near();
    error = bound_on(error * size + abs(f[k] - Ball(near[k])).upper_double());
  }
  // By Horner's scheme: alternating terms cancel before truncation.
  BallPolynomial value(near[kTerms - 1]);
  for (std::size_t k = kTerms - 1; k-- > 0;) {
    value = value * x;
    value += BallPolynomial(near[k]);
  }
  return value.widen(error);
}

/// A function that is smooth over the range of x, and whose fifth derivative is largest at `steepest` there.
BallPolynomial function_of(ArbSeries series, const BallPolynomial& x, const Ball& steepest) {
  const Ball middle(x.constant());
  const BallPolynomial deviation = x - BallPolynomial(x.constant());
  const Ball last = abs(expansion(series, steepest)[kTerms]);
  if (!x.known() || !last.finite()) {
    return BallPolynomial::everything();
  }
  const double size = abs(x.range() - middle).upper_double();
  return value_of_taylor(expansion(series, middle), deviation, size, last);
}

/// The cosine or the sine, whose fifth derivatives are at most 1.
BallPolynomial wave(const BallPolynomial& x, bool is_cosine) {
  if (!x.known()) {
    return BallPolynomial::everything();
  }
  spend(static_cast<std::int64_t>(kTerms));
  const Ball middle(x.constant());
  Ball c;
  Ball s;
  arb_sin_cos(s.raw(), c.raw(), middle.raw(), precision());
  static const Ball sixth = one / Ball(6.0);
  static const Ball twentyfourth = one / Ball(24.0);
  static const Ball remainder = one / Ball(120.0);
  const BallPolynomial deviation = x - BallPolynomial(x.constant());
  const double size = abs(x.range() - middle).upper_double();
  return is_cosine ? value_of_taylor({c, -s, -half * c, sixth * s, twentyfourth * c, zero}, deviation, size,
                                     remainder)
                   : value_of_taylor({s, c, -half * s, -sixth * c, twentyfourth * s, zero}, deviation, size,
                                     remainder);
}

}  // namespace

// 1/(c + d) minus its Taylor polynomial of degree four is -d^5/(c^5 (c + d)).
BallPolynomial reciprocal(const BallPolynomial& x) {
  const Ball middle(x.constant());
  const Ball all = x.range();
  const Ball size = abs(all - middle).upper();
  const Ball least = abs(middle) - size;
  if (!x.known() || !certainly_positive(least)) {
    return BallPolynomial::everything();
  }
  spend(static_cast<std::int64_t>(kTerms));
  std::array<Ball, kTerms + 1> coefficients;
  coefficients[0] = one / middle;
  for (std::size_t k = 1; k <= kTerms; ++k) {
    coefficients[k] = -(coefficients[k - 1] * coefficients[0]);
  }
  const BallPolynomial deviation = x - BallPolynomial(x.constant());
  return value_of_taylor(coefficients, deviation, size.upper_double(), abs(coefficients[kTerms - 1]) / least);
}
// The fifth derivatives of root and logarithm fall, that of the exponential rises.
BallPolynomial sqrt(const BallPolynomial& x) {
  const Ball all = x.range();
  return certainly_positive(all) ? function_of(arb_poly_sqrt_series, x, all.lower())
                                 : BallPolynomial::everything();
}
BallPolynomial exp(const BallPolynomial& x) {
  return function_of(arb_poly_exp_series, x, x.range().upper());
}
BallPolynomial log(const BallPolynomial& x) {
  const Ball all = x.range();
  return certainly_positive(all) ? function_of(arb_poly_log_series, x, all.lower())
                                 : BallPolynomial::everything();
}
BallPolynomial sin(const BallPolynomial& x) {
  return wave(x, false);
}
BallPolynomial cos(const BallPolynomial& x) {
  return wave(x, true);
}
BallPolynomial tangent(const BallPolynomial& x) {
  // No pole lies between two where the cosine vanishes.
  const Ball all = x.range();
  return certainly_positive(abs(cos(all))) ? function_of(arb_poly_tan_series, x, all)
                                           : BallPolynomial::everything();
}
// The coefficients of the series of the arc sine at 0 are not negative: its odd derivatives are even, and
// rise with |x|.
BallPolynomial arcsine(const BallPolynomial& x) {
  const Ball largest = abs(x.range()).upper();
  return certainly_less(largest, one) ? function_of(arb_poly_asin_series, x, largest)
                                      : BallPolynomial::everything();
}
BallPolynomial arccosine(const BallPolynomial& x) {
  const Ball largest = abs(x.range()).upper();
  return certainly_less(largest, one) ? function_of(arb_poly_acos_series, x, largest)
                                      : BallPolynomial::everything();
}
// The fifth derivative of the arc tangent is 4! cos(a)^5 sin(5 (a + pi/2)) at tan(a): at most 4! everywhere,
// where bounds of the series over a wide range are far larger, or infinite.
BallPolynomial arctangent(const BallPolynomial& x) {
  static_assert(kTerms == 5);
  if (!x.known()) {
    return BallPolynomial::everything();
  }
  spend(static_cast<std::int64_t>(kTerms));
  const Ball middle(x.constant());
  const Ball all = x.range();
  const Ball narrow = abs(expansion(arb_poly_atan_series, all)[kTerms]);
  static const Ball fifth = one / Ball(5.0);
  const BallPolynomial deviation = x - BallPolynomial(x.constant());
  return value_of_taylor(expansion(arb_poly_atan_series, middle), deviation, abs(all - middle).upper_double(),
                         certainly_less(narrow, fifth) ? narrow : fifth);
}

// With the constants x0 and y0 and w = (dx + i dy)/(x0 + i y0) = a + i b the angle is theirs and the
// imaginary part of log(1 + w), if 1 + a > 0: along the segment to (x, y), which stays in a half plane
// without the cut, both are continuous. It is that of w (1 - w (1/2 - w (1/3 - w/4))), and of a rest: w^5
// times the integral of (1 - t)^4/(1 + t w)^5 over t in [0, 1]. Where a >= -c > -1, |1 + t w| >= 1 - t c, and
// with u = (1 - t)/(1 - t c) the integral is at most that of u^4/(1 - c) over u in [0, 1]. So the truncated
// part is the same in all directions and depends on the size of w alone, whereas a quotient and its arc
// tangent are far wider. The rest is real where b = 0, and its derivative is w^4/(1 + w), where |1 + w| >=
// 1 - c: it is at most |b| |w|^4/(1 - c), too, which is less where the length changes more than the angle.
BallPolynomial arctangent2(const BallPolynomial& y, const BallPolynomial& x) {
  const Ball of_x = x.range();
  const Ball of_y = y.range();
  if (!certainly_positive(of_x) && !certainly_positive(of_y) && !certainly_positive(-of_y)) {
    return BallPolynomial::everything();
  }
  const Ball x0(x.constant());
  const Ball y0(y.constant());
  const Ball square_of_length = square(x0) + square(y0);
  const BallPolynomial by_x(x0 / square_of_length);
  const BallPolynomial by_y(y0 / square_of_length);
  const BallPolynomial dx = x - BallPolynomial(x.constant());
  const BallPolynomial dy = y - BallPolynomial(y.constant());
  const BallPolynomial a = by_x * dx + by_y * dy;
  const BallPolynomial b = by_x * dy - by_y * dx;
  const Ball backward = max(-a.range(), zero).upper();
  if (!certainly_less(backward, one)) {
    return BallPolynomial::everything();
  }
  const Ball size = sqrt(square(abs(a.range()).upper()) + square(abs(b.range()).upper()));
  static const Ball fifth = one / Ball(5.0);
  const Ball remainder = whole_power(size, 4) * min(fifth * size, abs(b.range()).upper()) / (one - backward);
  static const Ball third = one / Ball(3.0);
  BallPolynomial real = BallPolynomial(third) - 0.25 * a;
  BallPolynomial imaginary = -0.25 * b;
  for (const double coefficient : {0.5, 1.0}) {
    const BallPolynomial turned = a * imaginary + b * real;
    real = BallPolynomial(coefficient) - (a * real - b * imaginary);
    imaginary = -turned;
  }
  return (BallPolynomial(arctangent2(y0, x0)) + a * imaginary + b * real).widen(remainder.upper_double());
}

BallPolynomial stays_within(const BallPolynomial& x, const BallPolynomial& low, const BallPolynomial& high) {
  return certainly_less(low.range(), x.range()) && certainly_less(x.range(), high.range())
             ? x
             : BallPolynomial::everything();
}

}  // namespace veritrack::checker
