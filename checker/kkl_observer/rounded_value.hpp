// Bounds on what IEEE 754 double precision makes of a value: on the size of the exact one, and on how far the
// computed one is from it (docs/rounding.md, The KKL observer).
//
// In units in which the filters' states have length 1 and are between 2^-240 and 2^240 in the program's own.
// All values scale like powers up to the second of it: below 2^540 here nothing overflows there, and half
// of the smallest number there is 2^-595 here at most.
#pragma once

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

struct RoundedValue {
  Ball size, error;

  /// Its exact value is known to be at most this.
  [[nodiscard]] RoundedValue within(const Ball& known) const { return {min(size, known).upper(), error}; }
};

/// Something that the program holds exactly.
inline RoundedValue held(const Ball& size) {
  return {abs(size).upper(), zero};
}

/// An operation whose exact result, of exact operands, is within `size`, and of computed ones within `error`
/// of that. `units`: of roundoff, by which it is rounded.
inline RoundedValue rounded(const Ball& size, const Ball& error, const Ball& units = one) {
  static const Ball kRoundoff(0x1p-53);
  static const Ball kUnderflow(0x1p-595);
  static const Ball kLargest(0x1p540);
  const Ball largest = (size + error).upper();
  if (!certainly_at_most(largest, kLargest)) {
    return {Ball::everything(), Ball::everything()};
  }
  return {size.upper(), (error + units * (kRoundoff * largest + kUnderflow)).upper()};
}

/// Sums and differences.
inline RoundedValue operator+(const RoundedValue& x, const RoundedValue& y) {
  return rounded(x.size + y.size, x.error + y.error);
}
inline RoundedValue operator*(const RoundedValue& x, const RoundedValue& y) {
  return rounded(x.size * y.size, x.size * y.error + x.error * y.size + x.error * y.error);
}
/// x/y, of which |y| >= least and |x/y| <= size are known.
inline RoundedValue quotient(const RoundedValue& x, const RoundedValue& y, const Ball& least,
                             const Ball& size) {
  const Ball divisor = (least - y.error).lower();
  if (!certainly_positive(divisor)) {
    return {Ball::everything(), Ball::everything()};
  }
  return rounded(size, (x.error + size * y.error) / divisor);
}
/// The root of x, of which x >= least > 0 is known. Not a number where the computed x may be negative.
inline RoundedValue root(const RoundedValue& x, const Ball& least) {
  const Ball computed = (least - x.error).lower();
  return rounded(sqrt(x.size), x.error / (sqrt(least.lower()) + sqrt(computed)));
}

}  // namespace veritrack::checker
