#include "analysis/rigor/interval.hpp"

#include <doctest/doctest.h>

#include "tests/analysis/rigor/mpfr_oracle.hpp"
#include "tests/analysis/rigor/operands.hpp"

using namespace veritrack;
using namespace veritrack::test;
using rigor::Interval;

namespace {

constexpr std::int64_t kIntervalCases = 200'000;

/// The smallest lower and the largest upper bound of an operation at the corners of a box.
template <typename Function>
Interval range_at_corners(Function function, const Interval& a, const Interval& b) {
  static Oracle x;
  static Oracle y;
  static Oracle exact;
  double lower = kInfinity;
  double upper = -kInfinity;
  for (const double s : {a.lower(), a.upper()}) {
    for (const double t : {b.lower(), b.upper()}) {
      x = s;
      y = t;
      exact.evaluate(function, x.value(), y.value());
      lower = std::min(lower, exact.rounded_down());
      upper = std::max(upper, exact.rounded_up());
    }
  }
  return bounds(lower, upper);
}

}  // namespace

TEST_CASE("sum, difference, product and quotient hold every value and are the tightest") {
  using BinaryFunction = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
  constexpr BinaryFunction kFunctions[] = {mpfr_add, mpfr_sub, mpfr_mul, mpfr_div};
  Operands operands(10);
  Oracle s;
  Oracle t;
  Oracle exact;
  Misses misses;
  for (std::int64_t round = effort(kIntervalCases); round > 0; --round) {
    const Interval x = operands.interval();
    const Interval y = operands.interval();
    const double point_of_x = operands.point_of(x);
    const double point_of_y = operands.point_of(y);
    s = point_of_x;
    t = point_of_y;
    Interval results[4];
    {
      const rigor::UpwardRounding mode;
      results[0] = x + y;
      results[1] = x - y;
      results[2] = x * y;
      results[3] = x / y;
    }
    const bool corners_are_exact = rigor::is_finite(x) && rigor::is_finite(y) && round % 4 == 0;
    for (int index = 0; index < 4; ++index) {
      const Interval& result = results[index];
      if (index == 3 && rigor::contains(y, 0.0)) {
        misses.expect(rigor::is_empty(result), "quotient by zero", x, y, result);
        continue;
      }
      exact.evaluate(kFunctions[index], s.value(), t.value());
      misses.expect(exact.lies_in(result), "containment", static_cast<double>(index), x, y, point_of_x,
                    point_of_y, result);
      if (corners_are_exact) {
        const Interval tightest = range_at_corners(kFunctions[index], x, y);
        misses.expect(rigor::identical(result, tightest), "tightness", static_cast<double>(index), x, y,
                      result);
      }
    }
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("operations on points are at most one unit in the last place wide") {
  Operands operands(11);
  Misses misses;
  for (std::int64_t round = effort(kIntervalCases); round > 0; --round) {
    const Interval x(operands.number());
    const Interval y(operands.number());
    const rigor::UpwardRounding mode;
    for (const Interval& result : {x + y, x - y, x * y, square(x), sqrt(abs(x))}) {
      misses.expect(std::nextafter(result.lower(), kInfinity) >= result.upper(), "width", x, y, result);
    }
    if (y.lower() != 0.0) {
      const Interval result = x / y;
      misses.expect(std::nextafter(result.lower(), kInfinity) >= result.upper(), "width of quotient", x, y,
                    result);
    }
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("square, square root and integer powers hold every value") {
  Operands operands(12);
  Oracle s;
  Oracle exact;
  Misses misses;
  for (std::int64_t round = effort(kIntervalCases); round > 0; --round) {
    const Interval x = operands.interval();
    const double point = operands.point_of(x);
    const int exponent = static_cast<int>(operands.random().below(20)) - 7;
    s = point;

    exact.evaluate(mpfr_sqr, s.value());
    misses.expect(exact.lies_in(upward([&] { return square(x); })), "square", x, point);

    const Interval root = upward([&] { return sqrt(x); });
    const bool has_root = x.lower() >= 0.0;
    exact.evaluate(mpfr_sqrt, s.value());
    misses.expect(has_root ? exact.lies_in(root) : rigor::is_empty(root), "sqrt", x, point, root);

    const Interval power = upward([&] { return pow(x, exponent); });
    if (exponent < 0 && rigor::contains(x, 0.0)) {
      misses.expect(rigor::is_empty(power), "pole of a power", x, power);
    } else if (exponent >= 0 || !rigor::is_empty(power)) {  // x^-n may underflow to a zero in the denominator
      exact.evaluate(mpfr_pow_si, s.value(), exponent);
      misses.expect(exact.lies_in(power), "power", static_cast<double>(exponent), x, point, power);
    }
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("powers of points are tight, signs included") {
  const rigor::UpwardRounding mode;
  CHECK(identical(pow(bounds(-2.0, 3.0), 2), bounds(0.0, 9.0)));
  CHECK(identical(pow(bounds(-2.0, 3.0), 3), bounds(-8.0, 27.0)));
  CHECK(identical(pow(bounds(-3.0, -2.0), 2), bounds(4.0, 9.0)));
  CHECK(identical(pow(bounds(-4.0, -2.0), -1), bounds(-0.5, -0.25)));
  CHECK(identical(pow(bounds(-4.0, 2.0), 0), Interval(1.0)));
  CHECK(rigor::is_empty(pow(bounds(0.0, 2.0), -2)));
  CHECK(identical(pow(Interval(2.0), std::numeric_limits<int>::min()),
                  Interval(1.0) / bounds(kLargest, kInfinity)));
  CHECK(identical(pow(Interval(1.0), std::numeric_limits<int>::min()), Interval(1.0)));
  CHECK(identical(square(bounds(-2.0, 3.0)), bounds(0.0, 9.0)));
}

TEST_CASE("abs, min, max, hull and intersection hold every value") {
  Operands operands(13);
  Misses misses;
  for (std::int64_t round = effort(kIntervalCases); round > 0; --round) {
    const Interval x = operands.interval();
    const Interval y = operands.coin() ? operands.interval() : operands.around(operands.point_of(x));
    const double s = operands.point_of(x);
    const double t = operands.point_of(y);
    const rigor::UpwardRounding mode;
    misses.expect(rigor::contains(abs(x), std::fabs(s)) && abs(x).lower() >= 0.0, "abs", x, s);
    misses.expect(rigor::contains(min(x, y), std::min(s, t)), "min", x, y, s, t);
    misses.expect(rigor::contains(max(x, y), std::max(s, t)), "max", x, y, s, t);
    const Interval both = hull(x, y);
    misses.expect(is_subset(x, both) && is_subset(y, both), "hull", x, y);
    misses.expect(
        both.lower() == std::min(x.lower(), y.lower()) && both.upper() == std::max(x.upper(), y.upper()),
        "tightness of the hull", x, y);
    const Interval common = intersection(x, y);
    misses.expect(rigor::contains(common, s) == rigor::contains(y, s), "intersection", x, y, s);
    misses.expect(rigor::is_empty(common) || (is_subset(common, x) && is_subset(common, y)), "common part", x,
                  y);
    misses.expect(rigor::contains(-x, -s), "negation", x, s);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("midpoint, radius, width, magnitude and mignitude bound what they say") {
  Operands operands(14);
  Oracle s;
  Oracle m;
  Oracle distance;
  Misses misses;
  for (std::int64_t round = effort(kIntervalCases); round > 0; --round) {
    const Interval x = operands.interval();
    const double point = operands.point_of(x);
    const double middle = upward([&] { return midpoint(x); });
    const double middle_to_nearest = midpoint(x);
    misses.expect(rigor::contains(abs(x), std::fabs(point)) && magnitude(x) >= std::fabs(point) &&
                      mignitude(x) <= std::fabs(point),
                  "magnitudes", x, point);
    s = x.upper();
    m = x.lower();
    if (!rigor::is_finite(x)) {
      misses.expect(std::isnan(middle), "midpoint of a half-line", x);
      continue;
    }
    distance.evaluate(mpfr_sub, s.value(), m.value());
    misses.expect(distance.is_at_most(upward([&] { return width(x); })), "width", x);
    misses.expect(rigor::contains(x, middle) && rigor::contains(x, middle_to_nearest), "midpoint", x, middle);
    s = point;
    m = middle;
    distance.evaluate(mpfr_sub, s.value(), m.value());
    const double reach = upward([&] { return radius(x); });
    misses.expect(distance.is_at_most(reach) && distance.is_at_least(-reach), "radius", x, point, reach);
    misses.expect(reach <= upward([&] { return rigor::mul_up(0.5, width(x)); }) * (1 + 1e-15) +
                               2e-16 * magnitude(x) + kSmallest,
                  "tightness of the radius", x, reach);
  }
  VERITRACK_CHECK_NO_MISSES(misses);
}

TEST_CASE("what is no set of real numbers is empty, and stays empty") {
  const rigor::UpwardRounding mode;
  const Interval empties[] = {Interval(),
                              Interval(kNaN),
                              Interval(kInfinity),
                              Interval(-kInfinity),
                              bounds(kNaN, 1.0),
                              bounds(1.0, kNaN),
                              bounds(2.0, 1.0),
                              bounds(kInfinity, kInfinity),
                              bounds(-kInfinity, -kInfinity),
                              rigor::symmetric(-1.0),
                              rigor::symmetric(kNaN),
                              intersection(bounds(0.0, 1.0), bounds(2.0, 3.0)),
                              Interval(1.0) / bounds(-1.0, 1.0),
                              Interval(1.0) / Interval(0.0),
                              Interval(0.0) / Interval(-0.0),
                              sqrt(bounds(-kSmallest, 1.0))};
  const Interval one(1.0);
  for (const Interval& empty : empties) {
    CHECK(rigor::is_empty(empty));
    CHECK_FALSE(rigor::is_finite(empty));
    CHECK(std::isnan(empty.lower()));
    CHECK(std::isnan(empty.upper()));
    CHECK(std::isnan(midpoint(empty)));
    CHECK(std::isnan(width(empty)));
    CHECK(std::isnan(magnitude(empty)));
    CHECK_FALSE(rigor::contains(empty, 0.0));
    CHECK_FALSE(is_subset(empty, one));
    CHECK_FALSE(is_subset(one, empty));
    CHECK_FALSE(is_interior(empty, one));
    CHECK_FALSE(empty == empty);
    for (const Interval& other : {one, Interval(0.0), bounds(-1.0, 2.0), Interval::entire(), Interval()}) {
      for (const Interval& result :
           {empty + other, other + empty, empty - other, other - empty, empty * other, other * empty,
            empty / other, other / empty, hull(empty, other), hull(other, empty), intersection(empty, other),
            intersection(other, empty), min(empty, other), min(other, empty), max(empty, other),
            max(other, empty)}) {
        CHECK(rigor::is_empty(result));
      }
    }
    for (const Interval& result :
         {-empty, abs(empty), square(empty), sqrt(empty), pow(empty, 2), pow(empty, 0)}) {
      CHECK(rigor::is_empty(result));
    }
  }
}

TEST_CASE("empty and unbounded intervals satisfy no predicate") {
  const rigor::UpwardRounding mode;
  const Interval others[] = {Interval(0.0), Interval(1.0),     Interval(-1.0), bounds(-kLargest, kLargest),
                             Interval(),    Interval::entire()};
  for (const Interval& x :
       {Interval(), Interval(kNaN), Interval::entire(), bounds(2.0, kInfinity), bounds(-kInfinity, -2.0),
        Interval(kLargest) + Interval(kLargest), Interval(-kLargest) * Interval(2.0)}) {
    CHECK_FALSE(rigor::is_finite(x));
    CHECK_FALSE(certainly_positive(x));
    CHECK_FALSE(certainly_negative(x));
    CHECK_FALSE(certainly_not_negative(x));
    for (const Interval& other : others) {
      CHECK_FALSE(certainly_less(x, other));
      CHECK_FALSE(certainly_less(other, x));
      CHECK_FALSE(certainly_less_equal(x, other));
      CHECK_FALSE(certainly_less_equal(other, x));
    }
  }
}

TEST_CASE("predicates are true only when certain") {
  const rigor::UpwardRounding mode;
  CHECK(certainly_less(bounds(0.0, 1.0), bounds(2.0, 3.0)));
  CHECK_FALSE(certainly_less(bounds(0.0, 1.0), bounds(1.0, 3.0)));
  CHECK(certainly_less_equal(bounds(0.0, 1.0), bounds(1.0, 3.0)));
  CHECK_FALSE(certainly_less_equal(bounds(0.0, 1.5), bounds(1.0, 3.0)));
  CHECK(certainly_positive(Interval(kSmallest)));
  CHECK_FALSE(certainly_positive(Interval(0.0)));
  CHECK_FALSE(certainly_negative(Interval(-0.0)));
  CHECK(certainly_not_negative(Interval(0.0)));
  CHECK(certainly_not_negative(bounds(0.0, 1.0)));
  CHECK_FALSE(certainly_not_negative(bounds(-kSmallest, 1.0)));
  CHECK(certainly_negative(Interval(-kSmallest)));
  CHECK(Interval(0.0) == Interval(-0.0));
  CHECK_FALSE(bounds(0.0, 1.0) == bounds(0.0, 1.0));
}

TEST_CASE("results that depend on the mode are refused where it is not held") {
  const Interval one(1.0);
  const Interval two(2.0);
  CHECK_THROWS_AS((void)certainly_less(one, two), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)certainly_less_equal(one, two), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)certainly_positive(one), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)certainly_negative(one), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)certainly_less(Interval(), two), rigor::RoundingModeError);
#ifndef NDEBUG
  CHECK_THROWS_AS((void)(one + two), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)(one - two), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)(one * two), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)(one / two), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)square(two), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)sqrt(two), rigor::RoundingModeError);
  CHECK_THROWS_AS((void)width(two), rigor::RoundingModeError);
#endif
}

TEST_CASE("half-lines multiply and divide like sets of real numbers") {
  const rigor::UpwardRounding mode;
  const Interval above = bounds(2.0, kInfinity);
  CHECK(identical(above * Interval(0.0), Interval(0.0)));
  CHECK(identical(bounds(-1.0, 0.0) * bounds(0.0, kInfinity), bounds(-kInfinity, 0.0)));
  CHECK(identical(Interval(1.0) / above, bounds(0.0, 0.5)));
  CHECK(identical(above / above, bounds(0.0, kInfinity)));
  CHECK(identical(above - above, Interval::entire()));
  CHECK(identical(square(Interval::entire()), bounds(0.0, kInfinity)));
  CHECK(identical(sqrt(above * Interval(2.0)), above));
}
