// Functions with kinks and jumps, over intervals, models and dual numbers (docs/model-proof.md, section 19).
//
// A model that is certain to be on one side of a kink has the values of that branch. Where it is not, a
// continuous function has the enclosure of a chord with a constant error: nothing is developed across a kink.
// Nothing is known then of a jump, and of the derivatives of all of them. Need the upward rounding mode.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <type_traits>

#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

/// Ball models and Taylor models: sets of functions, with a range that is empty where nothing is known.
template <typename Model>
concept FunctionModel = requires(const Model& x) {
  { x.range() } -> std::same_as<Interval>;
  x.widened(0.0);
};

[[nodiscard]] inline Interval maximum(const Interval& a, const Interval& b) {
  return is_finite(a) && is_finite(b)
             ? Interval::from_bounds(std::max(a.lower(), b.lower()), std::max(a.upper(), b.upper()))
             : Interval::empty();
}
[[nodiscard]] inline Interval minimum(const Interval& a, const Interval& b) {
  return -maximum(-a, -b);
}
[[nodiscard]] inline Interval absolute(const Interval& x) {
  return maximum(x, -x);
}
/// Empty where `low` may be above `high`.
[[nodiscard]] inline Interval clamped(const Interval& x, const Interval& low, const Interval& high) {
  return certainly_less_equal(low, high) ? minimum(maximum(x, low), high) : Interval::empty();
}
/// Empty where it is undecided, as all that may jump.
[[nodiscard]] inline Interval chosen(const Interval& positive, const Interval& a, const Interval& b) {
  return certainly_positive(positive)                    ? a
         : certainly_less_equal(positive, Interval(0.0)) ? b
                                                         : Interval::empty();
}
[[nodiscard]] inline Interval sign_of(const Interval& x) {
  return certainly_positive(x) ? Interval(1.0) : certainly_negative(x) ? Interval(-1.0) : Interval::empty();
}

namespace detail {

template <typename Model>
[[nodiscard]] Model nothing_known() {
  return Model(Interval::empty());
}

/// max(x, 0) where x may have either sign: with the chord's slope t on [l, u], l < 0 < u, it is t x and at
/// most max((1 - t) u, -t l) more, being convex and at least t x.
template <FunctionModel Model>
[[nodiscard]] Model above_zero(const Model& x, const Interval& range) {
  const double slope = std::min(1.0, range.upper() / (range.upper() - range.lower()));
  const Interval t(slope);
  const Interval more = maximum((Interval(1.0) - t) * Interval(range.upper()), -t * Interval(range.lower()));
  if (!is_finite(more) || !(slope >= 0.0)) {
    return nothing_known<Model>();
  }
  return x * Model(slope) + Model(Interval::from_bounds(0.0, more.upper()));
}

/// 1 or -1 where the sign is certain, else 0.
[[nodiscard]] inline int certain_sign(double x) {
  return x > 0.0 ? 1 : x <= 0.0 ? -1 : 0;
}
[[nodiscard]] inline int certain_sign(const Interval& x) {
  return certainly_positive(x) ? 1 : certainly_negative(x) ? -1 : 0;
}
template <FunctionModel Model>
[[nodiscard]] int certain_sign(const Model& x) {
  return certain_sign(x.range());
}

}  // namespace detail

template <FunctionModel Model>
[[nodiscard]] Model maximum(const Model& a, const Model& b) {
  const Model difference = a - b;
  const Interval range = difference.range();
  if (!is_finite(range)) {
    return detail::nothing_known<Model>();
  }
  return certainly_not_negative(range)                ? a
         : certainly_less_equal(range, Interval(0.0)) ? b
                                                      : b + detail::above_zero(difference, range);
}
template <FunctionModel Model>
[[nodiscard]] Model minimum(const Model& a, const Model& b) {
  return -maximum(-a, -b);
}
template <FunctionModel Model>
[[nodiscard]] Model absolute(const Model& x) {
  return maximum(x, -x);
}
/// Nothing is known where `low` may be above `high`.
template <FunctionModel Model>
[[nodiscard]] Model clamped(const Model& x, const Model& low, const Model& high) {
  return certainly_not_negative((high - low).range()) ? minimum(maximum(x, low), high)
                                                      : detail::nothing_known<Model>();
}
template <FunctionModel Model>
[[nodiscard]] Model chosen(const Model& positive, const Model& a, const Model& b) {
  const Interval range = positive.range();
  return certainly_positive(range)                    ? a
         : certainly_less_equal(range, Interval(0.0)) ? b
                                                      : detail::nothing_known<Model>();
}
template <FunctionModel Model>
[[nodiscard]] Model sign_of(const Model& x) {
  const int sign = detail::certain_sign(x.range());
  return sign == 0 ? detail::nothing_known<Model>() : Model(static_cast<double>(sign));
}

/// Over what is not numbers unknown, derivatives included, where the sign may change.
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> chosen(const Dual<Scalar, N>& positive, const Dual<Scalar, N>& a,
                                     const Dual<Scalar, N>& b) {
  const int sign = detail::certain_sign(positive.value());
  if constexpr (std::is_floating_point_v<Scalar>) {
    return positive.value() > 0.0 ? a : b;
  }
  if (sign == 0) {
    const Scalar unknown = detail::nothing_known<Scalar>();
    std::array<Scalar, Dual<Scalar, N>::kSize> derivatives;
    derivatives.fill(unknown);
    return Dual<Scalar, N>(unknown, derivatives);
  }
  return sign < 0 ? b : a;
}
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> maximum(const Dual<Scalar, N>& a, const Dual<Scalar, N>& b) {
  return chosen(b - a, b, a);
}
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> minimum(const Dual<Scalar, N>& a, const Dual<Scalar, N>& b) {
  return chosen(a - b, b, a);
}
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> absolute(const Dual<Scalar, N>& x) {
  return chosen(x, x, -x);
}
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> clamped(const Dual<Scalar, N>& x, const Dual<Scalar, N>& low,
                                      const Dual<Scalar, N>& high) {
  return chosen(low - x, low, chosen(x - high, high, x));
}
template <typename Scalar, int N>
[[nodiscard]] Dual<Scalar, N> sign_of(const Dual<Scalar, N>& x) {
  const Dual<Scalar, N> one(1.0);
  return chosen(x, one, -one);
}

}  // namespace veritrack::rigor
