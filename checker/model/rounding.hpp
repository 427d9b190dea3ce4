// Error analysis of operations of doubles, in any mode of rounding.
#pragma once

namespace veritrack::checker {

/// The result of an operation is wrong by at most this share of itself, or by the subnormal unit.
constexpr double kRounding = 0x1p-52;

/// At least the exact x, whatever the roundings of up to 2^17 operations on non-negative numbers, and
/// underflows, took away from it.
inline double bound_on(double x) {
  return x * (1.0 + 0x1p-34) + 0x1p-500;
}

}  // namespace veritrack::checker
