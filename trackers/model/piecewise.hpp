// Functions with kinks and jumps, of numbers. Other scalars have their own, found by argument-dependent
// lookup.
#pragma once

#include <cmath>

namespace veritrack::trackers::detail {

/// The smaller number; the first where they are equal.
[[nodiscard]] inline double minimum(double a, double b) {
  return b < a ? b : a;
}
/// The larger number; the first where they are equal.
[[nodiscard]] inline double maximum(double a, double b) {
  return a < b ? b : a;
}
[[nodiscard]] inline double absolute(double x) {
  return std::fabs(x);
}
/// 1, -1, or x itself, which is 0 or no number.
[[nodiscard]] inline double sign_of(double x) {
  return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x;
}
/// `low` where x is less, else `high` where x is more, else x.
[[nodiscard]] inline double clamped(double x, double low, double high) {
  return x < low ? low : high < x ? high : x;
}
/// `a` where the first number is above 0, else `b`.
[[nodiscard]] inline double chosen(double positive, double a, double b) {
  return positive > 0.0 ? a : b;
}

}  // namespace veritrack::trackers::detail
