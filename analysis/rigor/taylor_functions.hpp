// Elementary functions of Taylor models, beside those that taylor_model.hpp has: a Taylor polynomial at the
// constant term and Lagrange's remainder, as for ball models. Need the upward rounding mode.
#pragma once

#include <algorithm>
#include <cstddef>
#include <tuple>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/taylor_coefficients.hpp"
#include "analysis/rigor/taylor_model.hpp"

namespace veritrack::rigor {

namespace detail {

/// f(x) = sum_{k < m} f^(k)(c)/k! (x - c)^k + f^(m)(t)/m! (x - c)^m, t between c and x, where m is Degree + 1
/// or, if that is less, the highest order with coefficients.
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> followed_by(TaylorCoefficients (*coefficients)(const Interval&),
                                                         const TaylorModel<Variables, Degree>& x) {
  using Model = TaylorModel<Variables, Degree>;
  constexpr std::size_t kLast =
      std::min(static_cast<std::size_t>(Degree) + 1, std::tuple_size_v<TaylorCoefficients> - 1);
  const Interval range = x.range();
  if (!is_finite(range)) {
    return Model();
  }
  const Interval constant(x.constant());
  const TaylorCoefficients at_constant = coefficients(constant);
  const Interval last = coefficients(range)[kLast];
  for (std::size_t k = 0; k < kLast; ++k) {
    if (!is_finite(at_constant[k])) {
      return Model();
    }
  }
  if (!is_finite(last)) {
    return Model();
  }
  const Model rest = x - Model(x.constant());
  Model result(at_constant[kLast - 1]);
  for (std::size_t k = kLast - 1; k-- > 0;) {
    result = result * rest + Model(at_constant[k]);
  }
  return result.widened((abs(last) * pow(abs(range - constant), static_cast<int>(kLast))).upper());
}

}  // namespace detail

// Nothing is known of the result where the function is not smooth or not defined.
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> sin(const TaylorModel<Variables, Degree>& x) {
  return sin_cos(x).first;
}
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> cos(const TaylorModel<Variables, Degree>& x) {
  return sin_cos(x).second;
}
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> tan(const TaylorModel<Variables, Degree>& x) {
  return detail::followed_by(taylor_of_tan, x);
}
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> asin(const TaylorModel<Variables, Degree>& x) {
  return detail::followed_by(taylor_of_asin, x);
}
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> acos(const TaylorModel<Variables, Degree>& x) {
  return detail::followed_by(taylor_of_acos, x);
}
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> atan(const TaylorModel<Variables, Degree>& x) {
  return detail::followed_by(taylor_of_atan, x);
}
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> sqrt(const TaylorModel<Variables, Degree>& x) {
  return detail::followed_by(taylor_of_sqrt, x);
}
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> exp(const TaylorModel<Variables, Degree>& x) {
  return detail::followed_by(taylor_of_exp, x);
}
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> log(const TaylorModel<Variables, Degree>& x) {
  return detail::followed_by(taylor_of_log, x);
}

/// The angle of (x, y), rad: that of the constants, and from there the angle to the rest, which is below a
/// right one.
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> atan2(const TaylorModel<Variables, Degree>& y,
                                                   const TaylorModel<Variables, Degree>& x) {
  using Model = TaylorModel<Variables, Degree>;
  const Model x0(x.constant());
  const Model y0(y.constant());
  const Model along = x * x0 + y * y0;
  const Model across = y * x0 - x * y0;
  const Interval angle = atan2(Interval(y.constant()), Interval(x.constant()));
  const Interval ranges = atan2(y.range(), x.range());
  if (!certainly_positive(along.range()) || is_empty(angle) || is_empty(ranges)) {
    return Model();
  }
  return Model(angle) + atan(across / along);
}

/// x; nothing is known of it unless low < x < high is shown.
template <int Variables, int Degree>
[[nodiscard]] TaylorModel<Variables, Degree> stays_within(const TaylorModel<Variables, Degree>& x,
                                                          const TaylorModel<Variables, Degree>& low,
                                                          const TaylorModel<Variables, Degree>& high) {
  const bool is_shown = certainly_positive((x - low).range()) && certainly_positive((high - x).range());
  return is_shown ? x : TaylorModel<Variables, Degree>();
}

}  // namespace veritrack::rigor
