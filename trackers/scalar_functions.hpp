// The few functions that the trackers need beyond + - * /, for any scalar.
//
// A tracker calls them unqualified after `using detail::square;` and so on. A scalar type with better
// versions in its own namespace (an interval whose square is never negative, one argument reduction for sine
// and cosine) has those found by argument-dependent lookup, and they win over the generic templates here.
#pragma once

#include <cmath>
#include <utility>

namespace veritrack::trackers::detail {

/// x^2.
template <typename Scalar>
[[nodiscard]] inline Scalar square(const Scalar& x) {
  return x * x;
}

/// (sin x, cos x), x in rad.
template <typename Scalar>
[[nodiscard]] inline std::pair<Scalar, Scalar> sin_cos(const Scalar& x) {
  using std::cos;
  using std::sin;
  return {sin(x), cos(x)};
}

/// x, which is not negative in real arithmetic. This informs the scalar types of an analysis, which may not
/// see it from the operands alone; numbers are left as they are.
template <typename Scalar>
[[nodiscard]] inline Scalar not_negative(const Scalar& x) {
  return x;
}

}  // namespace veritrack::trackers::detail
