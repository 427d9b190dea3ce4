// Rounded: the effect of IEEE 754 double precision on a computation, by running error analysis.
//
// A Rounded represents two values of a quantity: the exact one, of real arithmetic, and the computed one, of
// a program that does the same operations in double precision. It holds an enclosure of the exact value and a
// bound on |computed - exact|. Run on it, a template over its scalar bounds how far the same template over
// double can be from real arithmetic, for all inputs in a box.
//
// The promise is about programs in which
//   - every + - * / is rounded to nearest, in binary64, in the order
//     of the template: no -ffast-math, no -fassociative-math, no flush-to-zero, no excess precision (x87);
//   - sine and cosine are within one unit in the last place, as those of common C libraries are;
//   - a*b + c may be fused (-ffp-contract=fast): that leaves out one rounding, whose error the bound
//   contains.
//
// Per operation: the rounded result errs by at most u |result| + eta, with the unit roundoff u = 2^-53, and
// eta for results below the normal range. It must not overflow.
//
// Units. A computation whose quantities scale like powers, from -8 to 8, of a unit of length between 2^-60
// and 2^60 may be run with that length as 1: a relative error is the same in every unit. So that nothing
// over- or underflows in the program's own unit, a result must stay below 2^540, and eta is 2^-1075 * 2^480.
#pragma once

#include <limits>
#include <utility>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

/// See the top of this file. Every operation needs the upward mode; without it, and when nothing is known of
/// the exact value or the error, the error is infinite.
class Rounded {
 public:
  static constexpr double kUnitRoundoff = 0x1p-53;
  static constexpr double kUnderflow = 0x1p-595;
  static constexpr double kLargest = 0x1p540;
  static constexpr double kSmallestUnit = 0x1p-60;
  static constexpr double kLargestUnit = 0x1p60;

  /// A value about which nothing is known.
  Rounded() : Rounded(Interval(), kInfinity) {}
  /// A literal of the program, or an input that is exactly this number.
  explicit Rounded(double value) : Rounded(Interval(value), 0.0) {}
  /// Any double in the interval: the program reads the exact value.
  explicit Rounded(const Interval& exact) : Rounded(exact, 0.0) {}
  Rounded(const Interval& exact, double error) : exact_(exact), error_(checked(exact, error)) {}

  /// Contains the exact value.
  [[nodiscard]] const Interval& exact() const { return exact_; }
  /// At least |computed - exact|; infinite when no bound is known.
  [[nodiscard]] double error() const { return error_; }

  Rounded operator-() const { return {-exact_, error_}; }
  friend Rounded operator+(const Rounded& a, const Rounded& b) {
    return rounded(a.exact_ + b.exact_, add_up(a.error_, b.error_));
  }
  friend Rounded operator-(const Rounded& a, const Rounded& b) {
    return rounded(a.exact_ - b.exact_, add_up(a.error_, b.error_));
  }
  /// |a'b' - ab| <= |a||b' - b| + |a' - a||b| + |a' - a||b' - b|.
  friend Rounded operator*(const Rounded& a, const Rounded& b) {
    return rounded(a.exact_ * b.exact_, error_of_product(a, b));
  }
  /// a'/b' - a/b = ((a' - a) - (a/b)(b' - b)) / b'.
  friend Rounded operator/(const Rounded& a, const Rounded& b) {
    const Interval quotient = a.exact_ / b.exact_;
    const double least_divisor = sub_down(mignitude(b.exact_), b.error_);
    if (!(least_divisor > 0.0)) {
      return {quotient, kInfinity};
    }
    return rounded(quotient, div_up(add_up(a.error_, mul_up(magnitude(quotient), b.error_)), least_divisor));
  }
  friend Rounded square(const Rounded& a) { return rounded(rigor::square(a.exact_), error_of_product(a, a)); }
  /// Both have slopes of at most 1 and values of at most 1, whose unit in the last place is at most 2^-52.
  friend std::pair<Rounded, Rounded> sin_cos(const Rounded& x) {
    const auto [sine, cosine] = rigor::sin_cos(x.exact_);
    const double error = add_up(x.error_, 2.0 * kUnitRoundoff);
    return {Rounded(sine, error), Rounded(cosine, error)};
  }

  /// True only when both values are known and the same. Where they may be equal this says false, and so a
  /// template that divides by something only when it is not zero divides by something that may be zero: the
  /// error of the quotient is infinite.
  friend bool operator==(const Rounded& a, const Rounded& b) {
    return a.error_ == 0.0 && b.error_ == 0.0 && a.exact_ == b.exact_;
  }

  /// x, when its exact value is known not to be negative, whatever the enclosure says.
  friend Rounded not_negative(const Rounded& x) {
    return {intersection(x.exact_, Interval::from_bounds(0.0, kInfinity)), x.error_};
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  static double checked(const Interval& exact, double error) {
    const bool is_known = is_finite(exact) && error >= 0.0 && error <= kLargest;
    if (is_known) {
      return error;
    }
    return kInfinity;
  }
  static double error_of_product(const Rounded& a, const Rounded& b) {
    return add_up(add_up(mul_up(magnitude(a.exact_), b.error_), mul_up(a.error_, magnitude(b.exact_))),
                  mul_up(a.error_, b.error_));
  }
  /// The operation, from computed operands, gives what lies within `error` of `exact`, and is then rounded.
  static Rounded rounded(const Interval& exact, double error) {
    const double largest = add_up(magnitude(exact), error);
    if (!(largest <= kLargest)) {
      return {exact, kInfinity};
    }
    return {exact, add_up(error, add_up(mul_up(kUnitRoundoff, largest), kUnderflow))};
  }

  Interval exact_;
  double error_;
};

}  // namespace veritrack::rigor
