// Functions of a Rounded (rounded.hpp) beyond + - * /, and what Eigen needs to store it.
//
// The promise is about programs in which sqrt is rounded to nearest, as IEEE 754 demands, and exp is within
// one unit in the last place, as it is in common C libraries.
#pragma once

#include <algorithm>
#include <limits>

#include "analysis/rigor/eigen_scalar.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounded.hpp"

namespace veritrack::rigor {

namespace detail {

/// A result within `error` of the exact one before it is rounded by at most `units` halves of a unit in the
/// last place.
[[nodiscard]] inline Rounded rounded_once(const Interval& exact, double error, double units = 1.0) {
  const double largest = add_up(magnitude(exact), error);
  if (!(largest <= Rounded::kLargest)) {
    return {exact, std::numeric_limits<double>::infinity()};
  }
  const double rounding =
      add_up(mul_up(units * Rounded::kUnitRoundoff, largest), units * Rounded::kUnderflow);
  return {exact, add_up(error, rounding)};
}

}  // namespace detail

inline Rounded& operator+=(Rounded& a, const Rounded& b) {
  return a = a + b;
}
inline Rounded& operator-=(Rounded& a, const Rounded& b) {
  return a = a - b;
}

/// The larger one. Nothing is rounded; where one is certainly the larger, computed or exact, it is that one.
[[nodiscard]] inline Rounded max(const Rounded& a, const Rounded& b) {
  const auto at_most = [](const Rounded& x, const Rounded& y) {
    return add_up(x.exact().upper(), x.error()) <= sub_down(y.exact().lower(), y.error());
  };
  if (at_most(a, b)) {
    return b;
  }
  if (at_most(b, a)) {
    return a;
  }
  return {max(a.exact(), b.exact()), std::max(a.error(), b.error())};
}

/// |sqrt a' - sqrt a| = |a' - a| / (sqrt a' + sqrt a). Unknown where the computed a' may be negative.
[[nodiscard]] inline Rounded sqrt(const Rounded& a) {
  const double least = a.exact().lower();
  const double least_computed = sub_down(least, a.error());
  if (!(least_computed >= 0.0)) {
    return {};
  }
  const double roots = add_down(sqrt_down(least), sqrt_down(least_computed));
  return detail::rounded_once(sqrt(a.exact()), a.error() > 0.0 ? div_up(a.error(), roots) : 0.0);
}

/// |exp a' - exp a| <= exp(a) (exp |a' - a| - 1); a unit in the last place is two units of roundoff.
[[nodiscard]] inline Rounded exp(const Rounded& a) {
  const Interval exact = exp(a.exact());
  const Interval growth = exp(Interval(a.error())) - Interval(1.0);
  return detail::rounded_once(exact, mul_up(magnitude(exact), growth.upper()), 2.0);
}

/// It gives no bound for phases.
[[nodiscard]] inline Rounded atan2(const Rounded& /*y*/, const Rounded& /*x*/) {
  return {};
}

}  // namespace veritrack::rigor

template <>
struct Eigen::NumTraits<veritrack::rigor::Rounded>
    : veritrack::rigor::CostlyEigenScalar<veritrack::rigor::Rounded> {};
