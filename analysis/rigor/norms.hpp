// Spectral norms of interval matrices.
#pragma once

#include <optional>

#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/shapes.hpp"

namespace veritrack::rigor {

namespace detail {

[[nodiscard]] Interval spectral_norm(const DynamicIntervalMatrix& a);

/// An upper bound on the spectral norm of every real matrix E, of any shape, with |E| <= bounds entry by
/// entry; nothing unless the entries are finite and non-negative. Needs the upward mode.
///
/// Collatz and Wielandt (R. A. Horn, C. R. Johnson, Matrix Analysis, section 8.1): for a positive w,
/// |E|_2^2 <= max_i (B'B w)_i / w_i, B = bounds, since the right-hand side bounds the norm of E'E that max_i
/// |x_i|/w_i induces, and every norm bounds the spectral radius. Power iteration proposes w.
[[nodiscard]] std::optional<double> norm_of_bounded(const DynamicMatrix& bounds);

/// As norm_of_bounded, for symmetric E only: |E|_2 <= max_i (B w)_i / w_i. Linear in B, so sharper for tiny
/// entries.
[[nodiscard]] std::optional<double> norm_of_bounded_symmetric(const DynamicMatrix& bounds);

/// Item (1) of spectral_norm below: an upper bound on |A| for every A in `a`, by the columns of `v`, any
/// matrix near an orthogonal one. Nothing when that could not be verified. Needs the upward mode.
[[nodiscard]] std::optional<double> norm_through_vectors(const DynamicIntervalMatrix& a,
                                                         const DynamicIntervalMatrix& v);

}  // namespace detail

/// An interval that contains the spectral norm (largest singular value) of every real matrix in `a`, of any
/// shape; empty when an entry is not finite. Both ends have a relative error of about n 1e-16 for a matrix of
/// points. Sets its own rounding mode.
///
/// Upper end, the least of three. (1) With any point matrix V, G = V'V, |G - I| <= d < 1 and W = a V: for x =
/// V y, |A x|^2 = y'(W'W)y <= |W'W| |y|^2 and |x|^2 = y'G y >= (1 - d)|y|^2, so |A|^2 <= |W'W| / (1 - d);
/// approximate singular vectors V make W'W nearly diagonal, and its norm easy to bound. (2) The same for the
/// midpoint, plus the norm of the radius. (3) The norm of the entrywise magnitude. Lower end: |A v| / |v| at
/// an approximate singular vector.
template <typename Derived>
[[nodiscard]] Interval spectral_norm(const Eigen::MatrixBase<Derived>& a) {
  const UpwardRounding upward;
  return detail::spectral_norm(detail::to_dynamic(a));
}

/// The upper end of spectral_norm: |A|_2 <= the result for every A in `a`. Nothing when it is not finite.
template <typename Derived>
[[nodiscard]] std::optional<double> norm_upper_bound(const Eigen::MatrixBase<Derived>& a) {
  const Interval norm = spectral_norm(a);
  return is_finite(norm) ? std::optional<double>(norm.upper()) : std::nullopt;
}

}  // namespace veritrack::rigor
