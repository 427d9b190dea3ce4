// The ratios of elementary_ratios.hpp for dual numbers, by enclosures of their derivatives.
#pragma once

#include "analysis/contraction/elementary_ratios.hpp"
#include "analysis/rigor/dual.hpp"

namespace veritrack::contraction {

/// sin(x)/x with derivative -x h(x), h = 1/3 - x^2/30 + x^4/840 - ..., whose terms alternate and fall for
/// |x| <= 3: h lies between 1/3 - x^2/30 and 1/3.
template <int N>
[[nodiscard]] rigor::Dual<rigor::Interval, N> sine_ratio(const rigor::Dual<rigor::Interval, N>& x) {
  using rigor::Interval;
  const Interval third = Interval(1.0) / Interval(3.0);
  const Interval least = third - square(x.value()) / Interval(30.0);
  return x.chain(sine_ratio(x.value()), -(x.value() * hull(least, third)));
}

/// atan(t)/t with derivative -t h(t). atan(t)/t is the integral over u in [0, 1] of 1/(1 + t^2 u^2), so that
/// h is that of (1 - u^2) / ((1 + t^2 u^2) (1 + t^2)), which lies between 2/3 times 1/(1 + t^2)^2 and 1/(1 +
/// t^2).
template <int N>
[[nodiscard]] rigor::Dual<rigor::Interval, N> arctangent_ratio(const rigor::Dual<rigor::Interval, N>& t) {
  using rigor::Interval;
  const Interval decay = Interval(1.0) / (Interval(1.0) + square(t.value()));
  const Interval h = Interval(2.0) / Interval(3.0) * hull(square(decay), decay);
  return t.chain(arctangent_ratio(t.value()), -(t.value() * h));
}

}  // namespace veritrack::contraction
