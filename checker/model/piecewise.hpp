// Functions with kinks and jumps: of balls, and by what other scalars need to have them. A scalar has
// larger(x, y), clamped(x, low, high), chosen(positive, a, b), which is a where positive > 0 and b elsewhere,
// and sign_of(x).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

inline Ball larger(const Ball& x, const Ball& y) {
  return max(x, y);
}
/// Nothing known where `low` may be above `high`.
inline Ball clamped(const Ball& x, const Ball& low, const Ball& high) {
  return certainly_at_most(low, high) ? min(max(x, low), high) : Ball::everything();
}
/// Nothing known where it is undecided.
inline Ball chosen(const Ball& positive, const Ball& a, const Ball& b) {
  return certainly_positive(positive) ? a : certainly_not_negative(Ball(-positive)) ? b : Ball::everything();
}
inline Ball sign_of(const Ball& x) {
  return certainly_positive(x) ? one : certainly_positive(Ball(-x)) ? -one : Ball::everything();
}

/// The sign of a comparison behind the name `if`: see FormulaStep.
inline bool is_choice(const std::string& name) {
  return name == "if <" || name == "if <=" || name == "if >" || name == "if >=";
}

/// |x|, by the larger of x and -x where a scalar has nothing of its own.
template <typename Scalar>
Scalar absolute(const Scalar& x) {
  return larger(x, Scalar(-x));
}

/// The value of min, max, abs, sign, clamp or if, the latter of x - y, a and b; or nothing for other
/// functions.
template <typename Scalar>
std::optional<Scalar> value_of_piecewise(const std::string& name, const std::vector<Scalar>& arguments) {
  const std::size_t count = arguments.size();
  if (name == "max" && count == 2) {
    return larger(arguments[0], arguments[1]);
  }
  if (name == "min" && count == 2) {
    return Scalar(-larger(Scalar(-arguments[0]), Scalar(-arguments[1])));
  }
  if (name == "abs" && count == 1) {
    return absolute(arguments[0]);
  }
  if (name == "sign" && count == 1) {
    return sign_of(arguments[0]);
  }
  if (name == "clamp" && count == 3) {
    return clamped(arguments[0], arguments[1], arguments[2]);
  }
  if (!is_choice(name) || count != 3) {
    return std::nullopt;
  }
  // x < y where -(x - y) > 0; x <= y unless x - y > 0.
  const bool is_turned = name == "if <" || name == "if >=";
  const bool is_opposite = name == "if <=" || name == "if >=";
  return chosen(is_turned ? Scalar(-arguments[0]) : arguments[0], arguments[is_opposite ? 2 : 1],
                arguments[is_opposite ? 1 : 2]);
}

}  // namespace veritrack::checker
