// Real numbers as balls: Arb's arb_t with C++ operators. Every result contains the exact result for all
// points of its operands; a result that is undefined somewhere on its operands is a ball of everything, for
// which no comparison is true.
#pragma once

#include <arb.h>

#include <string>
#include <string_view>
#include <utility>

#include "checker/numbers/budget.hpp"
#include "checker/numbers/call_site.hpp"

namespace veritrack::checker {

namespace detail {
inline slong precision_bits = 128;
}
/// The precision of all arithmetic, in bits. Set once, before anything is computed.
inline slong precision() {
  return detail::precision_bits;
}
void set_precision(slong bits);

/// A set of reals, midpoint +- radius. "Not a number" is possible, and nothing is certain about it.
class Ball {
 public:
  Ball() { arb_init(x_); }
  /// Exactly this double.
  Ball(double value) : Ball() { arb_set_d(x_, value); }  // NOLINT(google-explicit-constructor)
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(x_, other.x_); }
  ~Ball() {
    // Numbers of at most two limbs lie in x_ itself; this test saves the calls for nearly every ball.
    if (ARF_HAS_PTR(arb_midref(x_)) || COEFF_IS_MPZ(ARF_EXP(arb_midref(x_))) ||
        COEFF_IS_MPZ(MAG_EXP(arb_radref(x_)))) {
      arb_clear(x_);
    }
  }
  Ball& operator=(const Ball& other) {
    arb_set(x_, other.x_);
    return *this;
  }
  Ball& operator=(Ball&& other) noexcept {
    arb_swap(x_, other.x_);
    return *this;
  }

  /// All reals: no comparison with it is true.
  static Ball everything();
  /// All reals from the least of `low` to the greatest of `high`.
  static Ball hull(const Ball& low, const Ball& high);
  /// All reals from `end`, exactly, to at least `other`: no point lies beyond `end`, which must be exact.
  static Ball from_end(const Ball& end, const Ball& other);
  /// All reals between -|x| and |x|.
  static Ball within(const Ball& x);

  /// Certainly finite: neither infinities nor "not a number" among the points.
  [[nodiscard]] bool finite() const { return arb_is_finite(x_) != 0; }
  /// The ends of the ball, rounded outward to this many bits, as exact balls.
  [[nodiscard]] Ball lower(slong bits = precision()) const;
  [[nodiscard]] Ball upper(slong bits = precision()) const;
  /// The middle and the radius of the ball, as exact balls.
  [[nodiscard]] Ball middle() const;
  [[nodiscard]] Ball radius() const;
  /// The nearest double to the midpoint: a proposal, never evidence.
  [[nodiscard]] double near() const { return arf_get_d(arb_midref(x_), ARF_RND_NEAR); }
  /// A double that is certainly not below any point; infinity or "not a number" when there is none.
  [[nodiscard]] double upper_double() const;
  /// Likewise one that is certainly not above any point.
  [[nodiscard]] double lower_double() const;
  /// At most `digits` digits, for people.
  [[nodiscard]] std::string text(slong digits = 12) const;

  [[nodiscard]] arb_ptr raw() { return x_; }
  [[nodiscard]] arb_srcptr raw() const { return x_; }

  Ball& operator+=(const Ball& y) {
    spend();
    arb_add(x_, x_, y.x_, precision());
    return *this;
  }
  Ball& operator-=(const Ball& y) {
    spend();
    arb_sub(x_, x_, y.x_, precision());
    return *this;
  }

 private:
  arb_t x_;
};

inline const Ball zero(0.0);
inline const Ball half(0.5);
inline const Ball one(1.0);
inline const Ball two(2.0);
inline const Ball four(4.0);

/// The value of one of Arb's functions, rounded to `precision()` bits.
template <typename Function, typename... Operands>
Ball value_of_arb(Function* function, const Operands&... operands) {
  spend();
  Ball z;
  function(z.raw(), operands.raw()..., precision());
  return z;
}

namespace detail {
/// Whether the radius is more than about 2^-16 of a midpoint that is not 0.
inline bool is_wide(const Ball& x) {
  const auto* middle = arb_midref(x.raw());
  const auto* radius = arb_radref(x.raw());
  return !arf_is_special(middle) && !mag_is_special(radius) && !COEFF_IS_MPZ(ARF_EXP(middle)) &&
         !COEFF_IS_MPZ(MAG_EXP(radius)) && MAG_EXP(radius) - ARF_EXP(middle) >= -16;
}
Ball product_of_ends(const Ball& x, const Ball& y);
Ball square_of_ends(const Ball& x);
/// Of a function that rises.
template <typename Function>
Ball value_by_ends(Function* function, const Ball& x) {
  return is_wide(x) ? Ball::hull(value_of_arb(function, x.lower()), value_of_arb(function, x.upper()))
                    : value_of_arb(function, x);
}
}  // namespace detail

inline Ball operator+(const Ball& x, const Ball& y) {
  return value_of_arb(arb_add, x, y);
}
inline Ball operator-(const Ball& x, const Ball& y) {
  return value_of_arb(arb_sub, x, y);
}
/// Of wide factors by their ends: midpoints and radii would be wider than the set of products.
inline Ball operator*(const Ball& x, const Ball& y) {
  return detail::is_wide(x) && detail::is_wide(y) ? detail::product_of_ends(x, y)
                                                  : value_of_arb(arb_mul, x, y);
}
inline Ball operator/(const Ball& x, const Ball& y) {
  return value_of_arb(arb_div, x, y);
}
inline Ball operator-(const Ball& x) {
  Ball z;
  arb_neg(z.raw(), x.raw());
  return z;
}
inline Ball abs(const Ball& x) {
  Ball z;
  arb_abs(z.raw(), x.raw());
  return z;
}
inline Ball reciprocal(const Ball& x) {
  return one / x;
}
/// Of a wide ball by the ends of |x|, so that no square is below 0.
inline Ball square(const Ball& x) {
  const bool is_narrow = arb_is_exact(x.raw()) != 0 || !x.finite() ||
                         (arf_is_zero(arb_midref(x.raw())) == 0 && !detail::is_wide(x));
  return is_narrow ? value_of_arb(arb_sqr, x) : detail::square_of_ends(x);
}
inline Ball sqrt(const Ball& x) {
  return detail::value_by_ends(arb_sqrt, x);
}
/// The root of a quantity that is certainly not negative although its ball may reach below zero.
inline Ball root_of_non_negative(const Ball& x) {
  return value_of_arb(arb_sqrtpos, x);
}
inline Ball log(const Ball& x) {
  return detail::value_by_ends(arb_log, x);
}
inline Ball exp(const Ball& x) {
  return value_of_arb(arb_exp, x);
}
inline Ball sin(const Ball& x) {
  return value_of_arb(arb_sin, x);
}
inline Ball cos(const Ball& x) {
  return value_of_arb(arb_cos, x);
}
inline Ball arcsine(const Ball& x) {
  return detail::value_by_ends(arb_asin, x);
}
inline Ball arctangent(const Ball& x) {
  return detail::value_by_ends(arb_atan, x);
}
inline Ball max(const Ball& x, const Ball& y) {
  return value_of_arb(arb_max, x, y);
}
inline Ball min(const Ball& x, const Ball& y) {
  return value_of_arb(arb_min, x, y);
}
Ball pi();

// A comparison is true only when it is true of all points; a false comparison proves nothing.
inline bool certainly_less(const Ball& x, const Ball& y CHECKER_PLACE) {
  CHECKER_IF_FORCED
  return x.finite() && y.finite() && arb_lt(x.raw(), y.raw()) != 0;
}
inline bool certainly_at_most(const Ball& x, const Ball& y CHECKER_PLACE) {
  CHECKER_IF_FORCED
  return x.finite() && y.finite() && arb_le(x.raw(), y.raw()) != 0;
}
inline bool certainly_positive(const Ball& x CHECKER_PLACE) {
  CHECKER_IF_FORCED
  return x.finite() && arb_is_positive(x.raw()) != 0;
}
inline bool certainly_not_negative(const Ball& x CHECKER_PLACE) {
  CHECKER_IF_FORCED
  return x.finite() && arb_is_nonnegative(x.raw()) != 0;
}
/// Both are exact and the same number.
inline bool certainly_equal(const Ball& x, const Ball& y CHECKER_PLACE) {
  CHECKER_IF_FORCED
  return x.finite() && y.finite() && arb_eq(x.raw(), y.raw()) != 0;
}

/// The known range of a value: it is in `low`, or anywhere from `low` to `high`.
struct Range {
  Ball low, high;
  Range(const Ball& value) : low(value), high(value) {}  // NOLINT(google-explicit-constructor)
  Range(Ball least, Ball most) : low(std::move(least)), high(std::move(most)) {}
};

/// sin(x)/x for |x| <= 3, and the g with (sin(x)/x)' = x g(x); atan(t)/t, and the g with (atan(t)/t)' = t
/// g(t). Continued to zero; balls of everything beyond the range.
struct Ratio {
  Ball value, slope;
};
Ratio sine_ratio(const Ball& x);
Ratio arctangent_ratio(const Ball& t);

/// A decimal as a design file writes it: sign, digits, point, exponent; underscores between digits. Throws
/// std::invalid_argument for anything else.
Ball from_decimal(std::string_view text, slong bits = precision());
/// A hexadecimal floating-point number of at most 53 bits, exactly: -0x1.8p-3. Throws std::invalid_argument.
Ball from_hexadecimal(std::string_view text);

}  // namespace veritrack::checker
