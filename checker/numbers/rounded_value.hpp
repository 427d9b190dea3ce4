// A computation in IEEE 754 double precision with known sizes of all results: for each result a bound on its
// exact size, and a bound on the difference of the program's result from it (docs/rounding.md).
//
// Assumed of the program: + - * / round to nearest, in a unit of length between 2^-60 and 2^60 times the unit
// of sizes, for quantities that scale like at most the 8th power of length; a product and a sum may be fused.
#pragma once

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// A bound on the size of an exact value, and on the difference of the program's value from it. Exact balls,
/// or balls of everything when there is no bound.
struct RoundedValue {
  Ball size, error;

  /// Its exact value is known to be at most this.
  [[nodiscard]] RoundedValue within(const Ball& known) const { return {min(size, known).upper(), error}; }
};

/// Something that the program holds exactly.
RoundedValue held(const Ball& size);

/// An operation whose exact result is within `size` for exact operands, and within `error` of that for
/// computed ones. `units`: the number of units of roundoff by which it is rounded.
RoundedValue rounded(const Ball& size, const Ball& error, const Ball& units = one);

/// Sums and differences.
RoundedValue sum(const RoundedValue& x, const RoundedValue& y);
RoundedValue product(const RoundedValue& x, const RoundedValue& y);
inline RoundedValue operator+(const RoundedValue& x, const RoundedValue& y) {
  return sum(x, y);
}
inline RoundedValue operator*(const RoundedValue& x, const RoundedValue& y) {
  return product(x, y);
}
/// x/y, where |y| >= least and |x/y| <= size are known.
RoundedValue quotient(const RoundedValue& x, const RoundedValue& y, const Ball& least, const Ball& size);
/// The root of x, where x >= least > 0 is known. Not a number where the computed x may be negative.
RoundedValue root(const RoundedValue& x, const Ball& least);

}  // namespace veritrack::checker
