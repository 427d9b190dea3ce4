// Positive definiteness of small symmetric interval matrices, where speed counts.
#pragma once

#include <array>
#include <cstddef>

#include "analysis/rigor/interval.hpp"

namespace veritrack::contraction {

/// A symmetric matrix of which only the entries [i][j] with j <= i are read.
template <std::size_t Size>
using LowerTriangle = std::array<std::array<rigor::Interval, Size>, Size>;

/// True only when every symmetric matrix in `a` is positive definite. The pivots of L D L' without
/// interchanges, enclosed: each real matrix in `a` has its own pivots in these enclosures, and positive
/// pivots mean definiteness. False says nothing. Needs the upward mode.
template <std::size_t Size>
[[nodiscard]] bool certainly_positive_definite(LowerTriangle<Size> a) {
  using rigor::Interval;
  for (std::size_t k = 0; k < Size; ++k) {
    if (!certainly_positive(a[k][k])) {
      return false;
    }
    const Interval reciprocal = Interval(1.0) / a[k][k];
    for (std::size_t i = k + 1; i < Size; ++i) {
      const Interval factor = a[i][k] * reciprocal;
      for (std::size_t j = k + 1; j < i; ++j) {
        a[i][j] -= factor * a[j][k];
      }
      a[i][i] -= rigor::square(a[i][k]) * reciprocal;
    }
  }
  return true;
}

}  // namespace veritrack::contraction
