// The polynomial identities behind the KKL observer (trackers/kkl_observer/kkl_observer.hpp), proved by exact
// evaluation.
//
// A polynomial of degree at most d in each of its variables that vanishes on the grid {0, ..., d}^n is zero
// (induction over the variables: in one variable it has d + 1 roots). The grids here are small and the
// integers exact, so that a loop is a proof, for all filter rates and all states at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "analysis/rigor/verdict.hpp"

namespace veritrack::kkl_observer {

/// Is the polynomial, of degree at most `degree` in each variable, zero? It is called with integers; its
/// values on the grid must fit into 64 bits. PROVED or REFUTED.
template <std::size_t Variables, typename Polynomial>
[[nodiscard]] rigor::Verdict is_zero_polynomial(const Polynomial& polynomial, std::int64_t degree) {
  std::array<std::int64_t, Variables> point{};
  for (;;) {
    if (polynomial(point) != 0) {
      return rigor::Verdict::refuted;
    }
    std::size_t at = 0;
    while (at < Variables && point[at] == degree) {
      point[at++] = 0;
    }
    if (at == Variables) {
      return rigor::Verdict::proved;
    }
    ++point[at];
  }
}

/// (3) for T of (6) with x1' = -x2, x2' = x3 x1: the residual, times lambda^2 + x3, is the zero polynomial.
[[nodiscard]] rigor::Verdict transform_is_invariant();

/// The same with x1' = x2, x2' = -x3 x1, the sign of the printed phase formula: REFUTED.
[[nodiscard]] rigor::Verdict transform_is_invariant_with_other_sign();

/// det(L'L) = |M xi|^2 for the printed M, for all rates and all xi.
[[nodiscard]] rigor::Verdict determinant_is_excitation();

/// M lambda = 0 and M 1 = 0 for the printed M.
[[nodiscard]] rigor::Verdict null_space_holds_lambda_and_one();

}  // namespace veritrack::kkl_observer
