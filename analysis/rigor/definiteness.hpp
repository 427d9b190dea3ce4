// Positive definiteness of interval matrices.
#pragma once

#include <optional>

#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/shapes.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::rigor {

namespace detail {
[[nodiscard]] Verdict is_positive_definite(const DynamicIntervalMatrix& a);
[[nodiscard]] std::optional<Eigen::VectorXd> find_non_positive_direction(const DynamicIntervalMatrix& a);
}  // namespace detail

/// Are the symmetric matrices in `a` positive definite? PROVED: all of them are. REFUTED: none of them is,
/// with a vector as witness (find_non_positive_direction). UNDECIDED otherwise, in particular when an entry
/// is not finite or when `a` contains no symmetric matrix. Throws std::invalid_argument unless a is square.
/// Sets its own rounding mode.
///
/// If X A X' has positive diagonal entries and, for some positive w, y_ii w_i > sum_j |y_ij| w_j, then by
/// Gershgorin (for the similar matrix diag(w)^-1 X A X' diag(w)) its eigenvalues are positive. Then no z but
/// zero has X'z = 0, since z'(X A X')z > 0; so X is nonsingular, every x is X'z for some z, and x'Ax = z'(X A
/// X')z > 0. The inverse Cholesky factor of the midpoint proposes X. Where that fails the smallest eigenvalue
/// decides (symmetric_eigenvalues), whose enclosure is tighter for wide entries.
template <typename Derived>
[[nodiscard]] Verdict is_positive_definite(const Eigen::MatrixBase<Derived>& a VERITRACK_CALL_SITE) {
  VERITRACK_MUTANT_RETURNS(Verdict::proved)
  const UpwardRounding upward;
  return detail::is_positive_definite(detail::to_dynamic(a));
}

/// A vector x, not zero, with x'Ax <= 0 for every symmetric A in `a`; nothing when none was found. Throws
/// std::invalid_argument unless a is square. Sets its own rounding mode.
template <typename Derived>
[[nodiscard]] auto find_non_positive_direction(const Eigen::MatrixBase<Derived>& a)
    -> std::optional<Vector<Derived::RowsAtCompileTime>> {
  const UpwardRounding upward;
  const std::optional<Eigen::VectorXd> witness = detail::find_non_positive_direction(detail::to_dynamic(a));
  if (!witness) {
    return std::nullopt;
  }
  return Vector<Derived::RowsAtCompileTime>(*witness);
}

}  // namespace veritrack::rigor
