// First derivatives by the chain rule, over any scalar.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "checker/model/formula.hpp"

namespace veritrack::checker {

/// A value and its derivatives with respect to some variables; no derivatives stand for zeros.
template <typename Scalar>
struct Jet {
  Scalar value;
  std::vector<Scalar> slopes;

  Jet(Scalar constant) : value(std::move(constant)) {}  // NOLINT(google-explicit-constructor)
  Jet(Scalar at, std::vector<Scalar> derivatives) : value(std::move(at)), slopes(std::move(derivatives)) {}
  /// Variable number `index` of `count`.
  static Jet variable(const Scalar& value, std::size_t index, std::size_t count) {
    std::vector<Scalar> slopes(count, Scalar(Ball(0.0)));
    slopes[index] = Scalar(Ball(1.0));
    return {value, std::move(slopes)};
  }
  [[nodiscard]] Scalar slope(std::size_t index) const {
    return slopes.empty() ? Scalar(Ball(0.0)) : slopes[index];
  }
};

/// f(x) where df/dx = slope.
template <typename Scalar>
Jet<Scalar> chain(const Jet<Scalar>& x, Scalar value, const Scalar& slope) {
  std::vector<Scalar> slopes;
  for (const Scalar& each : x.slopes) {
    slopes.push_back(slope * each);
  }
  return {std::move(value), std::move(slopes)};
}

/// f(x, y) where df/dx = by_x, df/dy = by_y.
template <typename Scalar>
Jet<Scalar> chain(const Jet<Scalar>& x, const Jet<Scalar>& y, Scalar value, const Scalar& by_x,
                  const Scalar& by_y) {
  if (y.slopes.empty()) {
    return chain(x, std::move(value), by_x);
  }
  if (x.slopes.empty()) {
    return chain(y, std::move(value), by_y);
  }
  std::vector<Scalar> slopes;
  for (std::size_t i = 0; i < x.slopes.size(); ++i) {
    slopes.push_back(by_x * x.slopes[i] + by_y * y.slopes[i]);
  }
  return {std::move(value), std::move(slopes)};
}

template <typename Scalar>
Jet<Scalar> operator+(const Jet<Scalar>& x, const Jet<Scalar>& y) {
  const Scalar one_(Ball(1.0));
  return chain(x, y, Scalar(x.value + y.value), one_, one_);
}
template <typename Scalar>
Jet<Scalar> operator-(const Jet<Scalar>& x, const Jet<Scalar>& y) {
  return chain(x, y, Scalar(x.value - y.value), Scalar(Ball(1.0)), Scalar(Ball(-1.0)));
}
template <typename Scalar>
Jet<Scalar> operator-(const Jet<Scalar>& x) {
  return chain(x, Scalar(-x.value), Scalar(Ball(-1.0)));
}
template <typename Scalar>
Jet<Scalar> operator*(const Jet<Scalar>& x, const Jet<Scalar>& y) {
  return chain(x, y, Scalar(x.value * y.value), y.value, x.value);
}
template <typename Scalar>
Jet<Scalar> operator/(const Jet<Scalar>& x, const Jet<Scalar>& y) {
  const Scalar inverse = Scalar(Ball(1.0)) / y.value;
  const Scalar quotient = x.value * inverse;
  return chain(x, y, quotient, inverse, Scalar(-quotient * inverse));
}
template <typename Scalar>
Jet<Scalar> sqrt(const Jet<Scalar>& x) {
  const Scalar root = sqrt(x.value);
  return chain(x, root, Scalar(Scalar(Ball(0.5)) / root));
}
template <typename Scalar>
Jet<Scalar> exp(const Jet<Scalar>& x) {
  const Scalar value = exp(x.value);
  return chain(x, value, value);
}
template <typename Scalar>
Jet<Scalar> log(const Jet<Scalar>& x) {
  return chain(x, Scalar(log(x.value)), Scalar(Scalar(Ball(1.0)) / x.value));
}
template <typename Scalar>
Jet<Scalar> sin(const Jet<Scalar>& x) {
  return chain(x, Scalar(sin(x.value)), Scalar(cos(x.value)));
}
template <typename Scalar>
Jet<Scalar> cos(const Jet<Scalar>& x) {
  return chain(x, Scalar(cos(x.value)), Scalar(-sin(x.value)));
}
template <typename Scalar>
Jet<Scalar> tangent(const Jet<Scalar>& x) {
  const Scalar value = tangent(x.value);
  return chain(x, value, Scalar(Scalar(Ball(1.0)) + value * value));
}
template <typename Scalar>
Scalar slope_of_arcsine(const Scalar& x) {
  return Scalar(Ball(1.0)) / sqrt(Scalar(Scalar(Ball(1.0)) - x * x));
}
template <typename Scalar>
Jet<Scalar> arcsine(const Jet<Scalar>& x) {
  return chain(x, Scalar(arcsine(x.value)), slope_of_arcsine(x.value));
}
template <typename Scalar>
Jet<Scalar> arccosine(const Jet<Scalar>& x) {
  return chain(x, Scalar(arccosine(x.value)), Scalar(-slope_of_arcsine(x.value)));
}
template <typename Scalar>
Jet<Scalar> arctangent(const Jet<Scalar>& x) {
  return chain(x, Scalar(arctangent(x.value)),
               Scalar(Scalar(Ball(1.0)) / (Scalar(Ball(1.0)) + x.value * x.value)));
}
template <typename Scalar>
Jet<Scalar> arctangent2(const Jet<Scalar>& y, const Jet<Scalar>& x) {
  const Scalar square_of_radius = x.value * x.value + y.value * y.value;
  return chain(y, x, Scalar(arctangent2(y.value, x.value)), Scalar(x.value / square_of_radius),
               Scalar(-y.value / square_of_radius));
}
template <typename Scalar>
Jet<Scalar> stays_within(const Jet<Scalar>& x, const Jet<Scalar>& low, const Jet<Scalar>& high) {
  return {stays_within(x.value, low.value, high.value), x.slopes};
}
// Where a branch is certain on a whole cell, its derivatives are those of the function there.
template <typename Scalar>
Jet<Scalar> chosen(const Jet<Scalar>& positive, const Jet<Scalar>& a, const Jet<Scalar>& b) {
  std::vector<Scalar> slopes;
  for (std::size_t i = 0; i < std::max(a.slopes.size(), b.slopes.size()); ++i) {
    slopes.push_back(chosen(positive.value, a.slope(i), b.slope(i)));
  }
  return {chosen(positive.value, a.value, b.value), std::move(slopes)};
}
template <typename Scalar>
Jet<Scalar> larger(const Jet<Scalar>& x, const Jet<Scalar>& y) {
  return chosen(x - y, x, y);
}
template <typename Scalar>
Jet<Scalar> clamped(const Jet<Scalar>& x, const Jet<Scalar>& low, const Jet<Scalar>& high) {
  return chosen(low - x, low, chosen(x - high, high, x));
}
template <typename Scalar>
Jet<Scalar> sign_of(const Jet<Scalar>& x) {
  return {sign_of(x.value)};
}

}  // namespace veritrack::checker
