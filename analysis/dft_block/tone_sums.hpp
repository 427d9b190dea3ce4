// The sums over the bins of a block that involve a tone and an estimate of it, enclosed over a cell.
//
// With s_m(x) = (-1)^m sinc(m + x), m = -L ... L, bin M - m of a tone with the offset x is 2 pi x1^2 s_m(x)
// e^{j (phase at the middle of the block)}: dft_block_ekf.hpp. All of these functions are entire, and their
// n-th derivatives are at most pi^n / (n + 1).
#pragma once

#include <array>
#include <cstddef>

#include "analysis/rigor/interval.hpp"

namespace veritrack::dft_block {

/// The largest L.
inline constexpr int kMostHalfWidth = 8;

/// For all m; entries beyond 2L + 1 are not used.
using TapValues = std::array<rigor::Interval, 2 * static_cast<std::size_t>(kMostHalfWidth) + 1>;

/// s_m and its first two derivatives over an interval of offsets, for m = -L ... L.
struct Taps {
  TapValues value, slope, bend;
};

/// Needs the upward mode.
[[nodiscard]] Taps enclose_taps(const rigor::Interval& offset, int half_width);

/// For the estimated offset x and the true one d: sums over m of products of s_m.
struct ToneSums {
  rigor::Interval value_value;   ///< s(x) s(x)
  rigor::Interval value_slope;   ///< s(x) s'(x)
  rigor::Interval slope_slope;   ///< s'(x) s'(x)
  rigor::Interval value_true;    ///< s(x) s(d)
  rigor::Interval slope_true;    ///< s'(x) s(d)
  rigor::Interval value_secant;  ///< s(x) (s(x) - s(d))/(x - d), the derivative where x = d
  rigor::Interval slope_secant;  ///< s'(x) (s(x) - s(d))/(x - d)
};

/// For all true offsets in `offset` and all errors x - d in `error`. Needs the upward mode.
[[nodiscard]] ToneSums enclose_tone_sums(const rigor::Interval& offset, const rigor::Interval& error,
                                         int half_width);

}  // namespace veritrack::dft_block
