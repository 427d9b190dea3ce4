// Enclosures of the solutions of linear systems and of inverses.
#pragma once

#include <optional>

#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/shapes.hpp"

namespace veritrack::rigor {

namespace detail {
[[nodiscard]] std::optional<DynamicIntervalMatrix> solve(const DynamicIntervalMatrix& a,
                                                         const DynamicIntervalMatrix& b);
}  // namespace detail

/// An enclosure of {A^-1 B : A in a, B in b}, and with it a proof that every matrix in `a` is nonsingular;
/// nothing when that could not be verified, or when an entry is not finite. a is n x n, b is n x m; throws
/// std::invalid_argument for other shapes. Sets its own rounding mode.
///
/// Krawczyk's operator with epsilon-inflation (S. M. Rump, "Verification methods", Acta Numerica 19 (2010),
/// theorem 10.2). With any point matrices R and X, Z = R (b - a X) and C = I - R a: if an interval column y
/// satisfies Z + C y in the interior of y, then every A in a is nonsingular and A^-1 B lies in X + Z + C y.
/// Proof: by Brouwer x -> R (B - A X) + (I - R A) x has a fixed point in y. Were R A singular, a whole line
/// of fixed points would pass through it and meet the boundary of y, which the map takes into the interior.
/// So R and A are nonsingular, and the fixed point is A^-1 B - X.
template <typename DerivedA, typename DerivedB>
[[nodiscard]] auto solve(const Eigen::MatrixBase<DerivedA>& a, const Eigen::MatrixBase<DerivedB>& b)
    -> std::optional<IntervalMatrix<DerivedA::ColsAtCompileTime, DerivedB::ColsAtCompileTime>> {
  const UpwardRounding upward;
  return detail::to_fixed<IntervalMatrix<DerivedA::ColsAtCompileTime, DerivedB::ColsAtCompileTime>>(
      detail::solve(detail::to_dynamic(a), detail::to_dynamic(b)));
}

/// An enclosure of {A^-1 : A in a}, and with it a proof that every matrix in `a` is nonsingular; nothing when
/// that could not be verified. As solve with the identity on the right.
template <typename Derived>
[[nodiscard]] auto inverse(const Eigen::MatrixBase<Derived>& a) {
  const UpwardRounding upward;
  using Result = IntervalMatrix<Derived::ColsAtCompileTime, Derived::RowsAtCompileTime>;
  const DynamicIntervalMatrix identity = DynamicIntervalMatrix::Identity(a.rows(), a.rows());
  return detail::to_fixed<Result>(detail::solve(detail::to_dynamic(a), identity));
}

}  // namespace veritrack::rigor
