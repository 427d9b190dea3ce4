#include "analysis/rigor/elementary_ratios.hpp"

#include <array>
#include <cmath>

#include "analysis/rigor/elementary.hpp"

namespace veritrack::rigor {

using rigor::Interval;

namespace {

/// sum_{i < terms} (-1)^i x^{2i} / c_i, by Horner's rule in x^2.
template <std::size_t Size>
Interval alternating_sum(double x, const std::array<double, Size>& divisors, std::size_t terms) {
  const Interval squared = rigor::square(Interval(x));
  Interval sum(0.0);
  for (std::size_t i = terms; i-- > 0;) {
    sum = Interval(i % 2 == 0 ? 1.0 : -1.0) / Interval(divisors[i]) + squared * sum;
  }
  return sum;
}

// (2i + 1)!, which is exact in a double up to this i, and 2i + 1.
constexpr std::array<double, 7> kFactorials = {1.0, 6.0, 120.0, 5040.0, 362880.0, 39916800.0, 6227020800.0};
constexpr std::array<double, 7> kOddNumbers = {1.0, 3.0, 5.0, 7.0, 9.0, 11.0, 13.0};

/// atan at a double >= 0. atan(x) = atan(c) + atan(u), u = (x - c)/(1 + c x), with c the multiple of 1/4
/// nearest to x: |u| <= 1/8, where the partial sums of the series lie alternately above and below atan(u)/u.
Interval arctangent(double x) {
  constexpr std::size_t kMultiples = 9;
  static const std::array<Interval, kMultiples> at_multiples = [] {
    std::array<Interval, kMultiples> values;
    for (std::size_t i = 0; i < kMultiples; ++i) {
      values.at(i) = rigor::atan(Interval(0.25 * static_cast<double>(i)));
    }
    return values;
  }();
  const double nearest = std::floor(4.0 * x + 0.5);
  const bool is_near = nearest < static_cast<double>(kMultiples);
  if (!is_near) {
    return rigor::atan(Interval(x));
  }
  const Interval multiple(0.25 * nearest);
  const Interval rest = (Interval(x) - multiple) / (Interval(1.0) + multiple * Interval(x));
  return at_multiples.at(static_cast<std::size_t>(nearest)) + rest * arctangent_ratio(rest);
}

}  // namespace

// sin(x)/x decreases on [0, pi], and for every x >= 0 the partial sums of its series lie alternately above
// and below it.
Interval sine_ratio(const Interval& x) {
  const Interval size = rigor::abs(x);
  if (!certainly_less_equal(size, Interval(3.0))) {
    return Interval::empty();
  }
  return Interval::from_bounds(alternating_sum(size.upper(), kFactorials, 6).lower(),
                               alternating_sum(size.lower(), kFactorials, 7).upper());
}

// atan(t)/t decreases for t >= 0. For t <= 1 the partial sums of its series lie alternately above and below
// it; beyond that the function itself is evaluated.
Interval arctangent_ratio(const Interval& t) {
  constexpr double kSeriesEnd = 0.5;
  const Interval size = rigor::abs(t);
  if (!is_finite(size)) {
    return Interval::empty();
  }
  const auto at = [](double point, std::size_t terms) {
    const Interval value(point);
    return point <= kSeriesEnd ? alternating_sum(point, kOddNumbers, terms) : arctangent(point) / value;
  };
  return Interval::from_bounds(at(size.upper(), 6).lower(), at(size.lower(), 7).upper());
}

// (sin x - x cos x)/x^3 = sum (-1)^i x^{2i} (2i + 2)/(2i + 3)!. By parts it is the integral of t sin(x t) / x
// over t in [0, 1], and each sin(x t)/x decreases in x on [0, pi]; the series alternates like that of the
// sine.
Interval sine_ratio_slope(const Interval& x) {
  const Interval size = rigor::abs(x);
  if (!certainly_less_equal(size, Interval(3.0))) {
    return Interval::empty();
  }
  // (2i + 3)!/(2i + 2).
  constexpr std::array<double, 7> kDivisors = {3.0,       30.0,        840.0,        45360.0,
                                               3991680.0, 518918400.0, 93405312000.0};
  return Interval::from_bounds(alternating_sum(size.upper(), kDivisors, 6).lower(),
                               alternating_sum(size.lower(), kDivisors, 7).upper());
}

// (atan(t)/t - 1/(1 + t^2))/t^2 is the integral of 2 u^2/(1 + t^2 u^2)^2 over u in [0, 1]: it decreases for t
// >= 0. For t <= 1 its series sum (-1)^i t^{2i} (2i + 2)/(2i + 3) alternates; beyond that the formula is
// evaluated.
Interval arctangent_ratio_slope(const Interval& t) {
  constexpr double kSeriesEnd = 0.25;
  const Interval size = rigor::abs(t);
  if (!is_finite(size)) {
    return Interval::empty();
  }
  const auto at = [](double point, std::size_t terms) {
    const Interval value(point);
    if (point <= kSeriesEnd) {
      Interval sum(0.0);
      const Interval squared = rigor::square(value);
      for (std::size_t i = terms; i-- > 0;) {
        const auto twice = static_cast<double>(2 * i);
        sum = Interval(i % 2 == 0 ? 1.0 : -1.0) * (Interval(twice + 2.0) / Interval(twice + 3.0)) +
              squared * sum;
      }
      return sum;
    }
    const Interval squared = rigor::square(value);
    return (arctangent(point) / value - Interval(1.0) / (Interval(1.0) + squared)) / squared;
  };
  return Interval::from_bounds(at(size.upper(), 6).lower(), at(size.lower(), 7).upper());
}

}  // namespace veritrack::rigor
