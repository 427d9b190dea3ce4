#include "checker/numbers/ball.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>

namespace veritrack::checker {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

[[noreturn]] void refuse(std::string_view text) {
  throw std::invalid_argument("not a number: " + std::string(text.substr(0, 60)));
}

/// Reads digits from `text` at `at`, appends them to `number`; false when there are none. An underscore is
/// allowed between two digits.
bool read_digits(std::string_view text, std::size_t& at, std::string& number) {
  const std::size_t first = at;
  while (at < text.size() &&
         (is_digit(text[at]) || (text[at] == '_' && at > first && is_digit(text[at - 1]) &&
                                 at + 1 < text.size() && is_digit(text[at + 1])))) {
    if (text[at] != '_') {
      number += text[at];
    }
    ++at;
  }
  return at > first;
}

/// An end of a ball, by one of Arb's functions for it, as an exact ball.
template <typename Function>
Ball end_of(Function* function, const Ball& x, slong to_bits) {
  Ball z;
  arf_t end;
  arf_init(end);
  function(end, x.raw(), to_bits);
  arb_set_arf(z.raw(), end);
  arf_clear(end);
  return z;
}

/// x = |t| at the two ends of a ball: an even function that is monotone in |t| lies between its values there.
template <typename Function>
Ball between_ends(const Ball& t, const Function& f) {
  return Ball::hull(f(end_of(arb_get_abs_lbound_arf, t, precision())),
                    f(end_of(arb_get_abs_ubound_arf, t, precision())));
}

/// Below this the ratios are replaced by bounds that are true between 0 and here: (1 +- 2^-38) of their
/// limits.
const Ball& smallest() {
  static const Ball threshold(std::ldexp(1.0, -20));
  return threshold;
}
Ball near_limit(const Ball& limit) {
  return Ball::hull(limit * (one - Ball(std::ldexp(1.0, -38))), limit * (one + Ball(std::ldexp(1.0, -38))));
}

}  // namespace

void set_precision(slong bits) {
  detail::precision_bits = std::clamp<slong>(bits, 64, 4096);
}

Ball detail::product_of_ends(const Ball& x, const Ball& y) {
  spend();
  Ball z;
  std::array<arf_struct, 4> ends;   // of x, then of y
  std::array<arf_struct, 3> found;  // the least product, the largest, and one of them
  std::for_each(ends.begin(), ends.end(), [](arf_struct& each) { arf_init(&each); });
  std::for_each(found.begin(), found.end(), [](arf_struct& each) { arf_init(&each); });
  arb_get_interval_arf(&ends[0], &ends[1], x.raw(), precision());
  arb_get_interval_arf(&ends[2], &ends[3], y.raw(), precision());
  for (std::size_t pair = 0; pair < 4; ++pair) {
    const arf_struct* of_x = &ends[pair / 2];
    const arf_struct* of_y = &ends[2 + pair % 2];
    arf_mul(&found[2], of_x, of_y, precision(), ARF_RND_FLOOR);
    if (pair == 0 || arf_cmp(&found[2], &found[0]) < 0) {
      arf_set(&found[0], &found[2]);
    }
    arf_mul(&found[2], of_x, of_y, precision(), ARF_RND_CEIL);
    if (pair == 0 || arf_cmp(&found[2], &found[1]) > 0) {
      arf_set(&found[1], &found[2]);
    }
  }
  arb_set_interval_arf(z.raw(), &found[0], &found[1], precision());
  std::for_each(ends.begin(), ends.end(), [](arf_struct& each) { arf_clear(&each); });
  std::for_each(found.begin(), found.end(), [](arf_struct& each) { arf_clear(&each); });
  return z;
}

Ball detail::square_of_ends(const Ball& x) {
  const auto squared = [](const Ball& t) { return value_of_arb(arb_sqr, t); };
  return arb_contains_zero(x.raw()) != 0
             ? Ball::from_end(zero, squared(end_of(arb_get_abs_ubound_arf, x, precision())))
             : between_ends(x, squared);
}

Ball Ball::everything() {
  Ball z;
  arb_indeterminate(z.x_);
  return z;
}

Ball Ball::hull(const Ball& low, const Ball& high) {
  Ball z;
  arb_union(z.x_, low.x_, high.x_, precision());
  return z;
}

Ball Ball::from_end(const Ball& end, const Ball& other) {
  // The middle is moved by the radius, rounded up, so that the rounding goes to the far side.
  Ball z;
  const Ball way = other - end;
  const bool upward = arb_is_positive(way.x_) != 0;
  arf_t most;
  arf_init(most);
  arb_get_abs_ubound_arf(most, way.x_, precision());
  arf_mul_2exp_si(most, most, -1);
  arf_get_mag(arb_radref(z.x_), most);
  arf_set_mag(most, arb_radref(z.x_));
  if (upward) {
    arf_add(arb_midref(z.x_), arb_midref(end.x_), most, ARF_PREC_EXACT, ARF_RND_DOWN);
  } else {
    arf_sub(arb_midref(z.x_), arb_midref(end.x_), most, ARF_PREC_EXACT, ARF_RND_DOWN);
  }
  arf_clear(most);
  return z;
}

Ball Ball::within(const Ball& x) {
  Ball z;
  arb_add_error(z.x_, x.x_);
  return z;
}

Ball Ball::lower(slong to_bits) const {
  return end_of(arb_get_lbound_arf, *this, to_bits);
}

Ball Ball::upper(slong to_bits) const {
  return end_of(arb_get_ubound_arf, *this, to_bits);
}

Ball Ball::middle() const {
  Ball z;
  arb_get_mid_arb(z.x_, x_);
  return z;
}

Ball Ball::radius() const {
  Ball z;
  arb_get_rad_arb(z.x_, x_);
  return z;
}

double Ball::upper_double() const {
  return finite() ? arf_get_d(arb_midref(upper().x_), ARF_RND_CEIL) : HUGE_VAL;
}

double Ball::lower_double() const {
  return finite() ? arf_get_d(arb_midref(lower().x_), ARF_RND_FLOOR) : -HUGE_VAL;
}

std::string Ball::text(slong digits) const {
  char* raw_text = arb_get_str(x_, digits, 0);
  std::string result(raw_text);
  flint_free(raw_text);
  return result;
}

Ball pi() {
  Ball z;
  arb_const_pi(z.raw(), precision());
  return z;
}

// With x = |x| u: sin(x)/x is the mean of cos(x u) over 0 <= u <= 1, hence falls with |x| up to pi; its g is
// minus the mean of u^2 sin(x u)/(x u), hence rises with |x| from -1/3.
Ratio sine_ratio(const Ball& x) {
  if (!certainly_at_most(abs(x), Ball(3.0))) {
    return {Ball::everything(), Ball::everything()};
  }
  const auto ratio = [](const Ball& t) { return value_of_arb(arb_sinc, t); };
  const auto slope = [](const Ball& t) {
    return certainly_less(smallest(), t) ? (cos(t) - sin(t) / t) / square(t) : near_limit(-one / Ball(3.0));
  };
  return {between_ends(x, ratio), between_ends(x, slope)};
}

// atan(t)/t is the mean of 1/(1 + t^2 u^2), hence falls with |t|; its g is minus twice the mean of
// u^2/(1 + t^2 u^2)^2, hence rises with |t| from -2/3.
Ratio arctangent_ratio(const Ball& t) {
  if (!t.finite()) {
    return {Ball::everything(), Ball::everything()};
  }
  const auto ratio = [](const Ball& x) {
    // cannot bind (x): a quotient by a ball that contains zero is a ball of everything, others are right.
    return certainly_less(smallest(), x) ? arctangent(x) / x : near_limit(one);
  };
  const auto slope = [&](const Ball& x) {
    // cannot bind (x): a quotient by a ball that contains zero is a ball of everything, others are right.
    return certainly_less(smallest(), x) ? (one / (one + square(x)) - ratio(x)) / square(x)
                                         : near_limit(-two / Ball(3.0));
  };
  return {between_ends(t, ratio), between_ends(t, slope)};
}

Ball from_decimal(std::string_view text, slong to_bits) {
  std::string number;
  std::size_t at = 0;
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) {
    number += text[at++];
  }
  if (text.size() > 400 || !read_digits(text, at, number)) {
    refuse(text);
  }
  if (at < text.size() && text[at] == '.') {
    number += text[at++];
    if (!read_digits(text, at, number)) {
      refuse(text);
    }
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    number += text[at++];
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) {
      number += text[at++];
    }
    const std::size_t exponent = number.size();
    if (!read_digits(text, at, number) || number.size() - exponent > 4) {
      refuse(text);
    }
  }
  Ball z;
  if (at != text.size() || arb_set_str(z.raw(), number.c_str(), to_bits) != 0 || !z.finite()) {
    refuse(text);
  }
  return z;
}

Ball from_hexadecimal(std::string_view text) {
  const std::string number(text);
  std::size_t at = number.starts_with('-') ? 1 : 0;
  const auto take = [&](std::string_view allowed, std::size_t most) {
    const std::size_t first = at;
    while (at < number.size() && allowed.find(number[at]) != std::string_view::npos) {
      ++at;
    }
    if (at == first || at - first > most) {
      refuse(text);
    }
    return number.substr(first, at - first);
  };
  take("0", 1);
  take("x", 1);
  std::string mantissa = take("01", 1);
  long exponent = 0;
  if (number.compare(at, 1, ".") == 0) {
    ++at;
    const std::string fraction = take("0123456789abcdef", 13);
    mantissa += fraction;
    exponent = -4 * static_cast<long>(fraction.size());
  }
  take("p", 1);
  const std::string sign = take("+-", 1);
  const long size = std::strtol(take("0123456789", 4).c_str(), nullptr, 10);
  exponent += sign == "-" ? -size : size;
  if (at != number.size()) {
    refuse(text);
  }
  Ball z;
  arb_set_ui(z.raw(), std::strtoull(mantissa.c_str(), nullptr, 16));
  arb_mul_2exp_si(z.raw(), z.raw(), exponent);
  return number.starts_with('-') ? -z : z;
}

}  // namespace veritrack::checker
