// A number with its derivatives with respect to a few variables: forward differentiation over balls.
#pragma once

#include <array>

#include "checker/numbers/ball.hpp"
#include "checker/numbers/gradient.hpp"

namespace veritrack::checker {

constexpr std::size_t kVariables = 4;

/// Over a box of the variables: all values, and all derivatives, of a smooth function there.
using Slope = Gradient<Ball, kVariables>;

// The same names for both kinds of numbers.
inline const Ball& value_of(const Ball& x) {
  return x;
}
inline const Ball& value_of(const Slope& x) {
  return x.value;
}
/// sin(x)/x and atan(t)/t.
inline Ball sine_over(const Ball& x) {
  return sine_ratio(x).value;
}
inline Slope sine_over(const Slope& x) {
  const Ratio ratio = sine_ratio(x.value);
  return x.chain(ratio.value, x.value * ratio.slope);
}
inline Ball arctangent_over(const Ball& t) {
  return arctangent_ratio(t).value;
}
inline Slope arctangent_over(const Slope& t) {
  const Ratio ratio = arctangent_ratio(t.value);
  return t.chain(ratio.value, t.value * ratio.slope);
}

}  // namespace veritrack::checker
