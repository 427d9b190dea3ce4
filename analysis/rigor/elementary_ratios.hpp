// sin(x)/x, (1 - cos x)/x^2 and atan(t)/t, continued to zero: the secant slopes by which a step of the
// tracker is written as a product of its errors.
#pragma once

#include <cmath>

#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

/// sin(x)/x.
[[nodiscard]] inline double sine_ratio(double x) {
  return std::fabs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x;
}
/// atan(t)/t.
[[nodiscard]] inline double arctangent_ratio(double t) {
  return std::fabs(t) < 1e-4 ? 1.0 - t * t / 3.0 : std::atan(t) / t;
}

/// sin(x)/x for |x| <= 3, empty beyond. Needs the upward mode.
[[nodiscard]] rigor::Interval sine_ratio(const rigor::Interval& x);
/// atan(t)/t. Needs the upward mode.
[[nodiscard]] rigor::Interval arctangent_ratio(const rigor::Interval& t);

/// -1/x times the derivative of sin(x)/x: (sin x - x cos x)/x^3, for |x| <= 3, empty beyond. Needs the upward
/// mode.
[[nodiscard]] rigor::Interval sine_ratio_slope(const rigor::Interval& x);
/// -1/t times the derivative of atan(t)/t: (atan(t)/t - 1/(1 + t^2))/t^2. Needs the upward mode.
[[nodiscard]] rigor::Interval arctangent_ratio_slope(const rigor::Interval& t);

template <int N>
[[nodiscard]] rigor::Dual<rigor::Interval, N> sine_ratio(const rigor::Dual<rigor::Interval, N>& x) {
  return x.chain(sine_ratio(x.value()), -(x.value() * sine_ratio_slope(x.value())));
}
template <int N>
[[nodiscard]] rigor::Dual<rigor::Interval, N> arctangent_ratio(const rigor::Dual<rigor::Interval, N>& t) {
  return t.chain(arctangent_ratio(t.value()), -(t.value() * arctangent_ratio_slope(t.value())));
}

/// (1 - cos x)/x^2 = (1/2) (sin(x/2)/(x/2))^2. Over intervals: for |x| <= 6, empty beyond.
template <typename Scalar>
[[nodiscard]] Scalar cosine_ratio(const Scalar& x) {
  const Scalar half = sine_ratio(Scalar(0.5) * x);
  return Scalar(0.5) * half * half;
}

}  // namespace veritrack::rigor
