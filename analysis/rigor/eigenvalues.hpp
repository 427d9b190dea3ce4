// Enclosures of all eigenvalues of symmetric matrices and of symmetric-definite pencils.
#pragma once

#include <optional>

#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/shapes.hpp"

namespace veritrack::rigor {

namespace detail {
[[nodiscard]] std::optional<DynamicIntervalMatrix> symmetric_eigenvalues(const DynamicIntervalMatrix& a);
[[nodiscard]] std::optional<DynamicIntervalMatrix> generalized_eigenvalues(const DynamicIntervalMatrix& a,
                                                                           const DynamicIntervalMatrix& b);
}  // namespace detail

/// Element i contains the i-th smallest eigenvalue of A x = lambda B x for every symmetric A in `a` and
/// symmetric B in `b`; a result proves that every such B is positive definite. Nothing when that could not be
/// verified, when an entry is not finite, or when a or b contains no symmetric matrix.
/// Both n x n; throws std::invalid_argument for other shapes. Sets its own rounding mode.
///
/// With any point matrix V, D = V'AV and G = V'BV. If |G - I| <= d < 1, then G is positive definite, so V is
/// nonsingular and B positive definite, and the eigenvalues are those of L^-1 D L^-T, G = L L'; by Ostrowski
/// (Horn and Johnson, Matrix Analysis, theorem 4.5.9) the i-th is theta_i times the i-th of D, theta_i in
/// [1/(1+d), 1/(1-d)]. By Weyl (theorem 4.3.1) the i-th of D differs from the i-th smallest diagonal entry by
/// at most the norm of the rest of D. Approximate eigenvectors V make G - I and that rest tiny.
template <typename DerivedA, typename DerivedB>
[[nodiscard]] auto generalized_eigenvalues(const Eigen::MatrixBase<DerivedA>& a,
                                           const Eigen::MatrixBase<DerivedB>& b)
    -> std::optional<IntervalVector<DerivedA::RowsAtCompileTime>> {
  const UpwardRounding upward;
  return detail::to_fixed<IntervalVector<DerivedA::RowsAtCompileTime>>(
      detail::generalized_eigenvalues(detail::to_dynamic(a), detail::to_dynamic(b)));
}

/// Element i contains the i-th smallest eigenvalue of every symmetric matrix in `a`. As
/// generalized_eigenvalues with B = I; for a matrix of wide intervals also by Weyl from its midpoint, plus or
/// minus the norm of its radius.
template <typename Derived>
[[nodiscard]] auto symmetric_eigenvalues(const Eigen::MatrixBase<Derived>& a)
    -> std::optional<IntervalVector<Derived::RowsAtCompileTime>> {
  const UpwardRounding upward;
  return detail::to_fixed<IntervalVector<Derived::RowsAtCompileTime>>(
      detail::symmetric_eigenvalues(detail::to_dynamic(a)));
}

}  // namespace veritrack::rigor
