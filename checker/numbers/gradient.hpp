// A number with its derivatives along several directions, over any kind of number: forward differentiation.
#pragma once

#include <array>
#include <utility>

namespace veritrack::checker {

template <typename S, std::size_t Directions>
struct Gradient {
  S value{};
  std::array<S, Directions> along{};  ///< zero unless set

  Gradient() = default;
  Gradient(S constant) : value(std::move(constant)) {}  // NOLINT(google-explicit-constructor)
  Gradient(double constant) : value(constant) {}        // NOLINT(google-explicit-constructor)

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
