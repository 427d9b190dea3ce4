// Requirements of the form of a step on its scalar: a double, an interval, or an interval with derivatives;
// of intervals, one or several side by side.
#pragma once

#include <cmath>

#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/interval.hpp"
#include "trackers/scalar_functions.hpp"

namespace veritrack::rigor {
template <int Lanes>
class IntervalLanes;  // interval_lanes.hpp, for units that compute with it
}  // namespace veritrack::rigor

namespace veritrack::quadrature::detail {

/// Without the derivatives.
inline double value_of(double x) {
  return x;
}
inline const rigor::Interval& value_of(const rigor::Interval& x) {
  return x;
}
template <int Lanes>
const rigor::IntervalLanes<Lanes>& value_of(const rigor::IntervalLanes<Lanes>& x) {
  return x;
}
template <typename Set, int N>
const Set& value_of(const rigor::Dual<Set, N>& x) {
  return x.value();
}

/// All fractions between 0 and these: over doubles the end. A point of the segment need not move with its
/// end, so there are no derivatives.
inline double up_to(double fraction) {
  return fraction;
}
inline rigor::Interval up_to(const rigor::Interval& fraction) {
  return rigor::hull(rigor::Interval(0.0), fraction);
}

/// sqrt of a quantity that is non-negative although its enclosure may not be.
inline double root(double x) {
  return std::sqrt(std::fmax(x, 0.0));
}
inline rigor::Interval root(const rigor::Interval& x) {
  return rigor::sqrt(rigor::max(x, rigor::Interval(0.0)));
}
template <int Lanes>
rigor::IntervalLanes<Lanes> root(const rigor::IntervalLanes<Lanes>& x) {
  return sqrt(max(x, rigor::IntervalLanes<Lanes>(0.0)));
}
inline double larger(double a, double b) {
  return a < b ? b : a;
}
inline rigor::Interval larger(const rigor::Interval& a, const rigor::Interval& b) {
  return rigor::max(a, b);
}
template <int Lanes>
rigor::IntervalLanes<Lanes> larger(const rigor::IntervalLanes<Lanes>& a,
                                   const rigor::IntervalLanes<Lanes>& b) {
  return max(a, b);
}
inline double size(double x) {
  return std::fabs(x);
}
inline rigor::Interval size(const rigor::Interval& x) {
  return rigor::abs(x);
}
template <int Lanes>
rigor::IntervalLanes<Lanes> size(const rigor::IntervalLanes<Lanes>& x) {
  return abs(x);
}
/// [-x, x], of the upper bound on x.
inline rigor::Interval at_most(const rigor::Interval& x) {
  return rigor::symmetric(x.upper());
}
template <int Lanes>
rigor::IntervalLanes<Lanes> at_most(const rigor::IntervalLanes<Lanes>& x) {
  return rigor::IntervalLanes<Lanes>::symmetric(x.upper());
}
/// The larger eigenvalue of [[a, b], [b, c]].
template <typename Scalar>
[[nodiscard]] Scalar larger_eigenvalue(const Scalar& a, const Scalar& b, const Scalar& c) {
  using trackers::detail::square;
  return Scalar(0.5) * (a + c) + root(Scalar(square(Scalar(0.5) * (a - c)) + square(b)));
}

}  // namespace veritrack::quadrature::detail
