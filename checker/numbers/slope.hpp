// A number with its derivatives with respect to a few variables: forward differentiation over balls.
#pragma once

#include <array>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

constexpr std::size_t kVariables = 4;

/// Over a box of the variables: all values, and all derivatives, of a smooth function there.
struct Slope {
  Ball value;
  std::array<Ball, kVariables> by;

  Slope() = default;
  Slope(Ball constant) : value(std::move(constant)) {}  // NOLINT(google-explicit-constructor)
  /// The variable of this index.
  static Slope variable(const Ball& range, std::size_t index) {
    Slope x(range);
    x.by[index] = Ball(1.0);
    return x;
  }
  /// f(x), given f and f' over the values of x.
  [[nodiscard]] Slope chain(const Ball& f, const Ball& derivative) const {
    Slope z(f);
    for (std::size_t i = 0; i < kVariables; ++i) {
      z.by[i] = derivative * by[i];
    }
    return z;
  }
};

inline Slope operator+(const Slope& x, const Slope& y) {
  Slope z(x.value + y.value);
  for (std::size_t i = 0; i < kVariables; ++i) {
    z.by[i] = x.by[i] + y.by[i];
  }
  return z;
}
inline Slope operator-(const Slope& x) {
  return x.chain(-x.value, Ball(-1.0));
}
inline Slope operator-(const Slope& x, const Slope& y) {
  return x + (-y);
}
inline Slope operator*(const Slope& x, const Slope& y) {
  Slope z(x.value * y.value);
  for (std::size_t i = 0; i < kVariables; ++i) {
    z.by[i] = x.by[i] * y.value + x.value * y.by[i];
  }
  return z;
}
inline Slope operator*(const Ball& x, const Slope& y) {
  return y.chain(x * y.value, x);
}
inline Slope operator*(const Slope& x, const Ball& y) {
  return y * x;
}
inline Slope reciprocal(const Slope& x) {
  const Ball over = Ball(1.0) / x.value;
  return x.chain(over, -square(over));
}
inline Slope operator/(const Slope& x, const Slope& y) {
  return x * reciprocal(y);
}
inline Slope square(const Slope& x) {
  return x.chain(square(x.value), Ball(2.0) * x.value);
}
inline Slope sqrt(const Slope& x) {
  const Ball root = sqrt(x.value);
  return x.chain(root, Ball(0.5) / root);
}
inline Slope sin(const Slope& x) {
  return x.chain(sin(x.value), cos(x.value));
}
inline Slope cos(const Slope& x) {
  return x.chain(cos(x.value), -sin(x.value));
}

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
