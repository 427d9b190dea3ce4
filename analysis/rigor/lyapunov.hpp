// Enclosures of the solutions of Lyapunov equations.
#pragma once

#include <optional>

#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/shapes.hpp"

namespace veritrack::rigor {

namespace detail {
[[nodiscard]] std::optional<DynamicIntervalMatrix> solve_discrete_lyapunov(const DynamicIntervalMatrix& a,
                                                                           const DynamicIntervalMatrix& q);
[[nodiscard]] std::optional<DynamicIntervalMatrix> solve_continuous_lyapunov(const DynamicIntervalMatrix& a,
                                                                             const DynamicIntervalMatrix& q);
}  // namespace detail

/// An enclosure, with mirrored entries identical, of the solution X of X = A X A' + Q for every A in `a` and
/// symmetric Q in `q`; it proves that this solution is unique, that is, that no two eigenvalues of A have the
/// product 1. Nothing when that could not be verified, when an entry is not finite, or when q
/// contains no symmetric matrix. A is stable (spectral radius below 1) if in addition Q and X are positive
/// definite: is_positive_definite decides. Both n x n; throws std::invalid_argument for other shapes. Sets
/// its own rounding mode.
///
/// The equation is a linear system for the n(n+1)/2 entries of X on and below the diagonal, which
/// linear_solve.hpp encloses. The eigenvalues of that system are 1 - lambda_i lambda_j, i <= j, the same
/// numbers as those of the equation for all n^2 entries, so that no solution that is not symmetric is missed.
template <typename DerivedA, typename DerivedQ>
[[nodiscard]] auto solve_discrete_lyapunov(const Eigen::MatrixBase<DerivedA>& a,
                                           const Eigen::MatrixBase<DerivedQ>& q)
    -> std::optional<IntervalMatrix<DerivedA::RowsAtCompileTime>> {
  const UpwardRounding upward;
  return detail::to_fixed<IntervalMatrix<DerivedA::RowsAtCompileTime>>(
      detail::solve_discrete_lyapunov(detail::to_dynamic(a), detail::to_dynamic(q)));
}

/// The same for A X + X A' + Q = 0; unique when no two eigenvalues of A have the sum 0. A is stable (real
/// parts below zero) if in addition Q and X are positive definite.
template <typename DerivedA, typename DerivedQ>
[[nodiscard]] auto solve_continuous_lyapunov(const Eigen::MatrixBase<DerivedA>& a,
                                             const Eigen::MatrixBase<DerivedQ>& q)
    -> std::optional<IntervalMatrix<DerivedA::RowsAtCompileTime>> {
  const UpwardRounding upward;
  return detail::to_fixed<IntervalMatrix<DerivedA::RowsAtCompileTime>>(
      detail::solve_continuous_lyapunov(detail::to_dynamic(a), detail::to_dynamic(q)));
}

}  // namespace veritrack::rigor
