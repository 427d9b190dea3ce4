// Positive definiteness of small symmetric interval matrices, where speed counts.
#pragma once

#include <array>
#include <cstddef>

#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

/// A symmetric matrix of which only the entries [i][j] with j <= i are read.
template <std::size_t Size, typename Scalar = rigor::Interval>
using LowerTriangle = std::array<std::array<Scalar, Size>, Size>;

namespace detail {
inline bool is_pivot(double x) {
  return x > 0.0;
}
inline bool is_pivot(const rigor::Interval& x) {
  return certainly_positive(x);
}
}  // namespace detail

/// Eliminates the first `count` rows and columns of `a` (L D L' without interchanges): the remaining block is
/// the Schur complement, or an enclosure of those of the matrices in `a`. False when a pivot is not
/// certainly positive. Over intervals it needs the upward mode.
template <std::size_t Size, typename Scalar>
[[nodiscard]] bool eliminate(LowerTriangle<Size, Scalar>& a, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    if (!detail::is_pivot(a[k][k])) {
      return false;
    }
    const Scalar reciprocal = Scalar(1.0) / a[k][k];
    for (std::size_t i = k + 1; i < Size; ++i) {
      const Scalar factor = a[i][k] * reciprocal;
      for (std::size_t j = k + 1; j < i; ++j) {
        a[i][j] -= factor * a[j][k];
      }
      a[i][i] -= a[i][k] * a[i][k] * reciprocal;
    }
  }
  return true;
}

/// True only when every symmetric matrix in `a` is positive definite: each real matrix in `a` has its own
/// pivots in the enclosures, and positive pivots imply definiteness. False proves nothing. Needs the upward
/// mode.
template <std::size_t Size>
[[nodiscard]] bool certainly_positive_definite(LowerTriangle<Size> a VERITRACK_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(true)
  return eliminate(a, Size);
}

}  // namespace veritrack::rigor
