// Dual numbers: a value with its first derivatives in N directions, over any scalar; nested duals give higher
// derivatives.
//
// Over intervals the promise of interval.hpp extends to derivatives: a result that is finite, value and
// derivatives, certifies that the expression was defined and differentiable on its operands, and encloses its
// value and its partial derivatives there. Where a value is undefined or discontinuous (the logarithm of a
// negative number, the branch cut of atan2) the derivatives are made empty with it, although a formula such
// as 1/x would be finite.
//
// Constants enter as Scalar or through the explicit constructor, which works from double at every depth of
// nesting: Dual<Dual<Interval, 3>, 3>(1.0). There is no implicit conversion from double to a Dual over
// intervals.
//
// Over double a Dual needs no rounding mode; over Interval it needs the one that Interval needs.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <utility>

#include "analysis/rigor/eigen_scalar.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

template <typename Scalar, int N>
class Dual;

namespace detail {

// Functions of a plain double that the chain rules below need; Interval and Dual have their own overloads.
inline double square(double x) {
  return x * x;
}
inline std::pair<double, double> sin_cos(double x) {
  return {std::sin(x), std::cos(x)};
}

[[nodiscard]] inline bool is_known(double x) noexcept {
  return !std::isnan(x);
}
[[nodiscard]] inline bool is_known(const Interval& x) noexcept {
  return !is_empty(x);
}
template <typename Scalar, int N>
[[nodiscard]] bool is_known(const Dual<Scalar, N>& x) noexcept {
  return is_known(x.value());
}

inline void make_unknown(double& x) noexcept {
  x = std::numeric_limits<double>::quiet_NaN();
}
inline void make_unknown(Interval& x) noexcept {
  x = Interval::empty();
}
template <typename Scalar, int N>
void make_unknown(Dual<Scalar, N>& x) noexcept {
  x.make_unknown();
}

/// `derivative` where `value` is known, empty where it is not.
template <typename Scalar>
[[nodiscard]] Scalar known_with(Scalar derivative, const Scalar& value) {
  if (!is_known(value)) {
    make_unknown(derivative);
  }
  return derivative;
}

}  // namespace detail

/// value + sum_i derivative(i) e_i with e_i e_j = 0. No allocation.
template <typename Scalar, int N>
class Dual {
 public:
  static constexpr std::size_t kSize = static_cast<std::size_t>(N);

  /// Must be assigned before use: zero over double, empty over intervals.
  Dual() = default;

  /// A constant: its derivatives are zero, or unknown when it is.
  explicit Dual(const Scalar& constant) : value_(constant) {
    derivatives_.fill(detail::known_with(Scalar(0.0), constant));
  }
  explicit Dual(double constant) requires(!std::same_as<Scalar, double>) : Dual(Scalar(constant)) {}
  explicit Dual(int constant) : Dual(Scalar(static_cast<double>(constant))) {}
  Dual(const Scalar& value, const std::array<Scalar, kSize>& derivatives)
      : value_(value), derivatives_(derivatives) {}

  [[nodiscard]] const Scalar& value() const noexcept { return value_; }
  /// The partial derivative in direction `index`, 0 <= index < N (not checked).
  [[nodiscard]] const Scalar& derivative(int index) const noexcept {
    return derivatives_[static_cast<std::size_t>(index)];
  }

  /// This function followed by a scalar function g: `value` is g at value(), `slope` is g' there.
  [[nodiscard]] Dual chain(const Scalar& value, const Scalar& slope) const {
    Dual result;
    result.value_ = value;
    for (std::size_t i = 0; i < kSize; ++i) {
      result.derivatives_[i] = slope * derivatives_[i];
    }
    return result;
  }

  void make_unknown() noexcept {
    detail::make_unknown(value_);
    for (Scalar& derivative : derivatives_) {
      detail::make_unknown(derivative);
    }
  }

  Dual operator-() const {
    Dual result;
    result.value_ = -value_;
    for (std::size_t i = 0; i < kSize; ++i) {
      result.derivatives_[i] = -derivatives_[i];
    }
    return result;
  }
  Dual& operator+=(const Dual& other) {
    value_ += other.value_;
    for (std::size_t i = 0; i < kSize; ++i) {
      derivatives_[i] += other.derivatives_[i];
    }
    return *this;
  }
  Dual& operator-=(const Dual& other) {
    value_ -= other.value_;
    for (std::size_t i = 0; i < kSize; ++i) {
      derivatives_[i] -= other.derivatives_[i];
    }
    return *this;
  }
  /// (f g)' = f' g + f g'.
  Dual& operator*=(const Dual& other) { return *this = *this * other; }
  /// (f / g)' = (f' - (f / g) g') / g. Over intervals: empty when g contains zero.
  Dual& operator/=(const Dual& other) { return *this = *this / other; }

  // With a constant of type Scalar: the same as with Dual(constant), at the cost of the scalar operation.
  Dual& operator+=(const Scalar& constant) { return *this += Dual(constant); }
  Dual& operator-=(const Scalar& constant) { return *this -= Dual(constant); }
  Dual& operator*=(const Scalar& constant) { return *this = chain(value_ * constant, constant); }
  Dual& operator/=(const Scalar& constant) {
    value_ /= constant;
    for (Scalar& derivative : derivatives_) {
      derivative /= constant;
    }
    return *this;
  }

  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual result;
    result.value_ = a.value_ * b.value_;
    for (std::size_t i = 0; i < kSize; ++i) {
      result.derivatives_[i] = a.derivatives_[i] * b.value_ + a.value_ * b.derivatives_[i];
    }
    return result;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual result;
    result.value_ = a.value_ / b.value_;
    const Scalar reciprocal = Scalar(1.0) / b.value_;
    for (std::size_t i = 0; i < kSize; ++i) {
      result.derivatives_[i] = (a.derivatives_[i] - result.value_ * b.derivatives_[i]) * reciprocal;
    }
    return result;
  }
  friend Dual operator+(Dual a, const Scalar& b) { return a += b; }
  friend Dual operator-(Dual a, const Scalar& b) { return a -= b; }
  friend Dual operator*(Dual a, const Scalar& b) { return a *= b; }
  friend Dual operator/(Dual a, const Scalar& b) { return a /= b; }
  friend Dual operator+(const Scalar& a, Dual b) { return b += a; }
  friend Dual operator-(const Scalar& a, const Dual& b) { return Dual(a) -= b; }
  friend Dual operator*(const Scalar& a, Dual b) { return b *= a; }
  friend Dual operator/(const Scalar& a, const Dual& b) { return Dual(a) / b; }

  /// Equality of value and derivatives, in the sense of Scalar: certain equality over intervals. Its negation
  /// would prove nothing there, so there is none.
  friend bool operator==(const Dual& a, const Dual& b) {
    return a.value_ == b.value_ && a.derivatives_ == b.derivatives_;
  }
  friend bool operator!=(const Dual& a, const Dual& b) = delete;

 private:
  Scalar value_{};
  std::array<Scalar, kSize> derivatives_{};
};

// ---- functions, by the chain rule

template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> square(const Dual<Scalar, N>& x) {
  using detail::square;
  return x.chain(square(x.value()), Scalar(2.0) * x.value());
}

/// Over intervals the derivatives are empty when x contains zero, where there is none.
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> sqrt(const Dual<Scalar, N>& x) {
  using std::sqrt;
  const Scalar root = sqrt(x.value());
  return x.chain(root, Scalar(0.5) / root);
}

/// x^exponent; x^0 is 1.
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> pow(const Dual<Scalar, N>& x, int exponent) {
  using std::pow;
  const Scalar value = Scalar(pow(x.value(), exponent));
  if (exponent == 0) {
    return Dual<Scalar, N>(value);
  }
  return x.chain(value, Scalar(static_cast<double>(exponent)) * Scalar(pow(x.value(), exponent - 1)));
}

template <typename Scalar, int N>
[[nodiscard]] std::pair<Dual<Scalar, N>, Dual<Scalar, N>> sin_cos(const Dual<Scalar, N>& x) {
  using detail::sin_cos;
  const std::pair<Scalar, Scalar> circle = sin_cos(x.value());
  return {x.chain(circle.first, circle.second), x.chain(circle.second, -circle.first)};
}

template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> sin(const Dual<Scalar, N>& x) {
  using detail::sin_cos;
  const std::pair<Scalar, Scalar> circle = sin_cos(x.value());
  return x.chain(circle.first, circle.second);
}

template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> cos(const Dual<Scalar, N>& x) {
  using detail::sin_cos;
  const std::pair<Scalar, Scalar> circle = sin_cos(x.value());
  return x.chain(circle.second, -circle.first);
}

/// Over intervals: empty when x contains a pole.
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> tan(const Dual<Scalar, N>& x) {
  using detail::square;
  using std::tan;
  const Scalar tangent = tan(x.value());
  return x.chain(tangent, Scalar(1.0) + square(tangent));
}

template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> atan(const Dual<Scalar, N>& x) {
  using detail::square;
  using std::atan;
  return x.chain(atan(x.value()), Scalar(1.0) / (Scalar(1.0) + square(x.value())));
}

/// The angle of (x, y). Over intervals: empty, derivatives included, when the box meets the branch cut or the
/// origin.
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> atan2(const Dual<Scalar, N>& y, const Dual<Scalar, N>& x) {
  using detail::square;
  using std::atan2;
  const Scalar angle = atan2(y.value(), x.value());
  const Scalar squared_length = square(x.value()) + square(y.value());
  const Scalar slope_in_y = detail::known_with(x.value() / squared_length, angle);
  const Scalar slope_in_x = detail::known_with(-y.value() / squared_length, angle);
  std::array<Scalar, static_cast<std::size_t>(N)> derivatives;
  for (int i = 0; i < N; ++i) {
    derivatives[static_cast<std::size_t>(i)] = slope_in_y * y.derivative(i) + slope_in_x * x.derivative(i);
  }
  return Dual<Scalar, N>(angle, derivatives);
}

template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> exp(const Dual<Scalar, N>& x) {
  using std::exp;
  const Scalar exponential = exp(x.value());
  return x.chain(exponential, exponential);
}

/// Over intervals: empty, derivatives included, unless x lies above zero.
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> log(const Dual<Scalar, N>& x) {
  using std::log;
  const Scalar logarithm = log(x.value());
  return x.chain(logarithm, detail::known_with(Scalar(1.0) / x.value(), logarithm));
}

}  // namespace veritrack::rigor

namespace Eigen {

template <typename Scalar, int N>
struct NumTraits<veritrack::rigor::Dual<Scalar, N>>
    : veritrack::rigor::CostlyEigenScalar<veritrack::rigor::Dual<Scalar, N>> {};

}  // namespace Eigen
