// Polynomial identities, proved by exact evaluation.
//
// A polynomial in n variables whose degree in each is at most d is zero if it vanishes on a grid of d + 1
// different values in each variable (by induction over n: for fixed values of the others a polynomial of one
// variable with more zeros than its degree is zero). On a grid of small integers every operation on doubles
// is exact, and the enclosures of interval arithmetic are points: no verdict is left to rounding.
#pragma once

#include <array>
#include <cstddef>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::rigor {

/// Is `difference`, a polynomial in N variables of degree at most `degree` in each, identically zero? PROVED:
/// it vanishes on the grid {-1, 0, 1, 2, ...}^N of degree + 1 values. REFUTED: at some point of the grid it
/// is certainly not zero. Needs the upward mode.
template <std::size_t N, typename Difference>
[[nodiscard]] Verdict vanishes(const Difference& difference, int degree) {
  std::array<int, N> index{};
  Verdict verdict = Verdict::proved;
  for (;;) {
    std::array<Interval, N> point;
    for (std::size_t i = 0; i < N; ++i) {
      point[i] = Interval(static_cast<double>(index[i] - 1));
    }
    const Interval value = difference(point);
    if (certainly_positive(value) || certainly_negative(value)) {
      return Verdict::refuted;
    }
    verdict = value == Interval(0.0) ? verdict : Verdict::undecided;
    std::size_t position = 0;
    while (position < N && index[position] == degree) {
      index[position] = 0;
      ++position;
    }
    if (position == N) {
      return verdict;
    }
    ++index[position];
  }
}

}  // namespace veritrack::rigor
