// The root of a number that is known not to be negative.
#pragma once

#include <algorithm>
#include <cmath>

#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::kkl_observer::detail {

/// The root of a number that is known not to be negative (or that counts as zero where it is), though its
/// enclosure may reach below zero. The derivatives of a dual number are then empty.
inline double root_of_non_negative(double x) {
  return std::sqrt(std::max(x, 0.0));
}
inline rigor::Interval root_of_non_negative(const rigor::Interval& x) {
  return sqrt(max(x, rigor::Interval(0.0)));
}
template <typename Scalar, int N>
rigor::Dual<Scalar, N> root_of_non_negative(const rigor::Dual<Scalar, N>& x) {
  const Scalar root = root_of_non_negative(x.value());
  return x.chain(root, Scalar(0.5) / root);
}

}  // namespace veritrack::kkl_observer::detail
