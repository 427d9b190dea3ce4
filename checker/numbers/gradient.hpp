// A number with its derivatives along several directions, over any kind of number: forward differentiation.
#pragma once

#include <array>
#include <utility>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

template <typename S, std::size_t Directions>
struct Gradient {
  S value{};
  std::array<S, Directions> along{};  ///< zero unless set

  Gradient() = default;
  Gradient(S constant) : value(std::move(constant)) {}  // NOLINT(google-explicit-constructor)
  Gradient(double constant) : value(constant) {}        // NOLINT(google-explicit-constructor)

  /// The variable of this index.
  static Gradient variable(S range, std::size_t index) {
    Gradient x(std::move(range));
    x.along[index] = S(one);
    return x;
  }
  /// f(x), given f and f' at the value of x.
  [[nodiscard]] Gradient chain(const S& f, const S& derivative) const {
    Gradient z(f);
    for (std::size_t i = 0; i < Directions; ++i) {
      z.along[i] = derivative * along[i];
    }
    return z;
  }

  friend Gradient operator+(const Gradient& x, const Gradient& y) {
    Gradient z(x.value + y.value);
    for (std::size_t i = 0; i < Directions; ++i) {
      z.along[i] = x.along[i] + y.along[i];
    }
    return z;
  }
  friend Gradient operator-(const Gradient& x, const Gradient& y) {
    Gradient z(x.value - y.value);
    for (std::size_t i = 0; i < Directions; ++i) {
      z.along[i] = x.along[i] - y.along[i];
    }
    return z;
  }
  friend Gradient operator*(const Gradient& x, const Gradient& y) {
    Gradient z(x.value * y.value);
    for (std::size_t i = 0; i < Directions; ++i) {
      z.along[i] = x.along[i] * y.value + x.value * y.along[i];
    }
    return z;
  }
  friend Gradient operator*(const Ball& x, const Gradient& y) { return y.chain(x * y.value, S(x)); }
  friend Gradient operator*(const Gradient& x, const Ball& y) { return y * x; }
  friend Gradient operator/(const Gradient& x, const Gradient& y) { return x * reciprocal(y); }
  friend Gradient operator-(const Gradient& x) { return Ball(-1.0) * x; }
  friend Gradient square(const Gradient& x) { return x.chain(square(x.value), two * x.value); }
  friend Gradient sqrt(const Gradient& x) {
    const S root = sqrt(x.value);
    return x.chain(root, half * reciprocal(root));
  }
  friend Gradient sin(const Gradient& x) { return x.chain(sin(x.value), cos(x.value)); }
  friend Gradient cos(const Gradient& x) { return x.chain(cos(x.value), -sin(x.value)); }
  friend Gradient arctangent(const Gradient& x) {
    return x.chain(arctangent(x.value), reciprocal(S(one) + square(x.value)));
  }
  friend Gradient reciprocal(const Gradient& x) {
    const S over = reciprocal(x.value);
    return x.chain(over, S(0.0) - over * over);
  }
  friend std::pair<Gradient, Gradient> sine_cosine(const Gradient& x) {
    const auto [sine, cosine] = sine_cosine(x.value);
    return {x.chain(sine, cosine), x.chain(cosine, S(0.0) - sine)};
  }
};

}  // namespace veritrack::checker
