// Interval: a closed set of real numbers, [lower, upper], enclosed with outward-rounded endpoints.
//
// The promise. If x, y, ... lie in the operand intervals then f(x, y, ...) lies in the result. More: a result
// that `is_finite` certifies that the expression was defined *and continuous* at every point of the operands.
// An operation that is undefined or discontinuous somewhere on its operands (division by an interval that
// contains zero, the square root of an interval that reaches below zero, the empty set, NaN, an infinite
// point) gives the empty interval, which means "nothing is known" and stays empty in every later operation.
// Overflow gives an unbounded interval. Neither an empty nor an unbounded interval ever satisfies a
// `certainly_...` predicate.
//
// Every operation needs the rounding mode that an UpwardRounding object sets (rounding.hpp). Builds without
// NDEBUG check this in each operation, all builds check it in each predicate.
//
// There is no implicit conversion from double: `Interval(0.1)` is the double nearest to 0.1
// and not the number 0.1, for which there is `parse_decimal` (decimal.hpp). Integers wider than 32 bits and
// long double do not convert at all.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/rigor/call_site.hpp"
#include "analysis/rigor/packed_bounds.hpp"
#include "analysis/rigor/rounding.hpp"

#ifdef VERITRACK_BOOST_INTERVALS
#include "analysis/rigor/boost_bounds.hpp"
#endif

namespace veritrack::rigor {

/// Whose sums, products, quotients and squares these are: docs/arithmetic.md.
#ifdef VERITRACK_BOOST_INTERVALS
namespace interval_operations = boosted;
#else
namespace interval_operations = packed;
#endif

/// A closed, possibly unbounded interval of reals, or the empty set. See the top of this file for its
/// promise.
class Interval {
 public:
  /// The empty interval, so that a forgotten value can never certify anything.
  Interval() noexcept : bounds_(packed::nothing()) {}

  /// The single real number that this double is. NaN and the infinities are not real numbers: empty.
  explicit Interval(double point) noexcept
      : bounds_(std::isfinite(point) ? packed::pack(point, point) : packed::nothing()) {}
  explicit Interval(float point) noexcept : Interval(static_cast<double>(point)) {}
  explicit Interval(int point) noexcept : bounds_(packed::pack(point, point)) {}
  template <typename T>
  explicit Interval(T) = delete;  // wider integers and long double would be rounded silently

  /// [lower, upper]. Empty unless lower <= upper, and for [+inf, +inf] and [-inf, -inf], which contain no
  /// real number.
  [[nodiscard]] static Interval from_bounds(double lower, double upper) noexcept {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const bool is_set = lower <= upper && lower < kInfinity && upper > -kInfinity;
    return Interval(is_set ? packed::pack(lower, upper) : packed::nothing());
  }
  [[nodiscard]] static Interval empty() noexcept { return {}; }
  /// (-inf, +inf): an arbitrary real number.
  [[nodiscard]] static Interval entire() noexcept {
    return from_bounds(-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
  }

  /// NaN when empty.
  [[nodiscard]] double lower() const noexcept { return packed::lower(bounds_); }
  /// NaN when empty.
  [[nodiscard]] double upper() const noexcept { return packed::upper(bounds_); }

  Interval operator-() const noexcept { return Interval(packed::negated(bounds_)); }
  Interval& operator+=(const Interval& other) { return *this = *this + other; }
  Interval& operator-=(const Interval& other) { return *this = *this - other; }
  Interval& operator*=(const Interval& other) { return *this = *this * other; }
  /// Empty when the divisor contains zero.
  Interval& operator/=(const Interval& other) { return *this = *this / other; }
  friend Interval operator+(const Interval& a, const Interval& b) {
    return Interval(interval_operations::sum(a.bounds_, b.bounds_));
  }
  friend Interval operator-(const Interval& a, const Interval& b) {
    return Interval(interval_operations::sum(a.bounds_, packed::negated(b.bounds_)));
  }
  friend Interval operator*(const Interval& a, const Interval& b) {
    return Interval(interval_operations::product(a.bounds_, b.bounds_));
  }
  friend Interval operator/(const Interval& a, const Interval& b) {
    return Interval(interval_operations::quotient(a.bounds_, b.bounds_));
  }
  /// {t^2 : t in x}: never negative, unlike x * x.
  [[nodiscard]] friend Interval square(const Interval& x) {
    return Interval(interval_operations::square(x.bounds_));
  }
  /// The smallest interval that contains both; empty when either is, because the empty interval means that
  /// nothing is known.
  [[nodiscard]] friend Interval hull(const Interval& a, const Interval& b) noexcept {
    return Interval(packed::hull(a.bounds_, b.bounds_));
  }

  /// Certain equality of real numbers: both are the same single point. Its negation would prove nothing, so
  /// there is none.
  friend bool operator==(const Interval& a, const Interval& b) noexcept {
    return a.lower() == a.upper() && b.lower() == b.upper() && a.lower() == b.lower();
  }
  friend bool operator!=(const Interval& a, const Interval& b) = delete;

 private:
  explicit Interval(__m128d bounds) noexcept : bounds_(bounds) {}
  __m128d bounds_;
};

[[nodiscard]] Interval square(const Interval& x);
[[nodiscard]] Interval hull(const Interval& a, const Interval& b) noexcept;

// ---- properties

[[nodiscard]] inline bool is_empty(const Interval& x) noexcept {
  const bool ordered = x.lower() <= x.upper();
  return !ordered;
}

/// Not empty, and both endpoints finite. False for anything that may not enter a proof.
[[nodiscard]] inline bool is_finite(const Interval& x) noexcept {
  return std::isfinite(x.lower()) && std::isfinite(x.upper()) && x.lower() <= x.upper();
}

/// A finite double inside a finite interval, near its middle; NaN otherwise. Independent of the rounding mode
/// up to one unit in the last place.
[[nodiscard]] inline double midpoint(const Interval& x) noexcept {
  if (!is_finite(x)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::clamp(0.5 * x.lower() + 0.5 * x.upper(), x.lower(), x.upper());
}

/// An upper bound on upper - lower; NaN when empty.
[[nodiscard]] inline double width(const Interval& x) {
  return sub_up(x.upper(), x.lower());
}

/// An upper bound on the distance from `midpoint(x)` to the points of x; NaN unless finite.
[[nodiscard]] inline double radius(const Interval& x) {
  const double middle = midpoint(x);
  return std::max(sub_up(x.upper(), middle), sub_up(middle, x.lower()));
}

/// The largest |t| for t in x; NaN when empty.
[[nodiscard]] inline double magnitude(const Interval& x) noexcept {
  return std::max(std::fabs(x.lower()), std::fabs(x.upper()));
}

/// The smallest |t| for t in x; NaN when empty.
[[nodiscard]] inline double mignitude(const Interval& x) noexcept {
  if (x.lower() <= 0.0 && x.upper() >= 0.0) {
    return 0.0;
  }
  return std::min(std::fabs(x.lower()), std::fabs(x.upper()));
}

[[nodiscard]] inline bool contains(const Interval& x, double point) noexcept {
  return x.lower() <= point && point <= x.upper();
}

/// True when `inner` is a non-empty part of `outer`.
[[nodiscard]] inline bool is_subset(const Interval& inner,
                                    const Interval& outer VERITRACK_CALL_SITE) noexcept {
  VERITRACK_MUTANT_RETURNS(true)
  return outer.lower() <= inner.lower() && inner.lower() <= inner.upper() && inner.upper() <= outer.upper();
}

/// True when `inner` is non-empty and lies in the topological interior of `outer`.
[[nodiscard]] inline bool is_interior(const Interval& inner,
                                      const Interval& outer VERITRACK_CALL_SITE) noexcept {
  VERITRACK_MUTANT_RETURNS(true)
  return outer.lower() < inner.lower() && inner.lower() <= inner.upper() && inner.upper() < outer.upper();
}

/// Same endpoints, or both empty. Not an equality of real numbers.
[[nodiscard]] inline bool identical(const Interval& a, const Interval& b) noexcept {
  return (is_empty(a) && is_empty(b)) || (a.lower() == b.lower() && a.upper() == b.upper());
}

// ---- predicates: true only when certain

// All require finite operands and the upward rounding mode (RoundingModeError otherwise). None is the
// negation of another.

/// Every point of a is less than every point of b.
[[nodiscard]] inline bool certainly_less(const Interval& a, const Interval& b VERITRACK_CALL_SITE) {
  require_upward_rounding();
  VERITRACK_MUTANT_RETURNS(true)
  return is_finite(a) && is_finite(b) && a.upper() < b.lower();
}
/// Every point of a is less than or equal to every point of b.
[[nodiscard]] inline bool certainly_less_equal(const Interval& a, const Interval& b VERITRACK_CALL_SITE) {
  require_upward_rounding();
  VERITRACK_MUTANT_RETURNS(true)
  return is_finite(a) && is_finite(b) && a.upper() <= b.lower();
}
[[nodiscard]] inline bool certainly_positive(const Interval& a VERITRACK_CALL_SITE) {
  return certainly_less(Interval(0.0), a VERITRACK_SAME_CALL_SITE);
}
[[nodiscard]] inline bool certainly_not_negative(const Interval& a VERITRACK_CALL_SITE) {
  return certainly_less_equal(Interval(0.0), a VERITRACK_SAME_CALL_SITE);
}
[[nodiscard]] inline bool certainly_negative(const Interval& a VERITRACK_CALL_SITE) {
  return certainly_less(a, Interval(0.0) VERITRACK_SAME_CALL_SITE);
}

// ---- set operations

/// The common points; empty when there are none.
[[nodiscard]] inline Interval intersection(const Interval& a, const Interval& b) noexcept {
  if (is_empty(a) || is_empty(b)) {
    return Interval::empty();
  }
  return Interval::from_bounds(std::max(a.lower(), b.lower()), std::min(a.upper(), b.upper()));
}

/// [-radius, radius]; empty unless radius >= 0.
[[nodiscard]] inline Interval symmetric(double radius) noexcept {
  return Interval::from_bounds(-radius, radius);
}

// ---- algebraic functions

[[nodiscard]] inline Interval abs(const Interval& x) noexcept {
  if (is_empty(x)) {
    return x;
  }
  return Interval::from_bounds(mignitude(x), magnitude(x));
}

[[nodiscard]] inline Interval min(const Interval& a, const Interval& b) noexcept {
  if (is_empty(a) || is_empty(b)) {
    return Interval::empty();
  }
  return Interval::from_bounds(std::min(a.lower(), b.lower()), std::min(a.upper(), b.upper()));
}

[[nodiscard]] inline Interval max(const Interval& a, const Interval& b) noexcept {
  if (is_empty(a) || is_empty(b)) {
    return Interval::empty();
  }
  return Interval::from_bounds(std::max(a.lower(), b.lower()), std::max(a.upper(), b.upper()));
}

/// Empty when x reaches below zero: for a quantity that is known to be non-negative write sqrt(max(x,
/// Interval(0.0))).
[[nodiscard]] inline Interval sqrt(const Interval& x) {
  const bool defined = x.lower() >= 0.0 && x.lower() <= x.upper();
  if (!defined) {
    return Interval::empty();
  }
  return Interval::from_bounds(sqrt_down(x.lower()), sqrt_up(x.upper()));
}

/// x^exponent. Empty when the exponent is negative and x contains zero. x^0 is 1.
[[nodiscard]] Interval pow(const Interval& x, int exponent);

}  // namespace veritrack::rigor
