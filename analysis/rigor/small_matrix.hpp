// Operations on small matrices of doubles, for proposals: Eigen's, behind plain functions so that each is
// compiled once. Nothing here is evidence; rounding is the caller's. They throw std::length_error for a
// result with more than kMostSmallRows rows or columns.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace veritrack::rigor {

/// Matrices of at most this many rows need no allocation.
inline constexpr int kMostSmallRows = 20;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostSmallRows, kMostSmallRows>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostSmallRows, 1>;
/// The argument of the functions: any matrix or block of doubles, without a copy.
using MatrixView = Eigen::Ref<const Eigen::MatrixXd>;

[[nodiscard]] SmallMatrix identity(Eigen::Index rows);
[[nodiscard]] SmallMatrix transposed(const MatrixView& a);
[[nodiscard]] SmallMatrix product(const MatrixView& a, const MatrixView& b);
/// A B'.
[[nodiscard]] SmallMatrix product_with_transpose(const MatrixView& a, const MatrixView& b);
/// F P F'.
[[nodiscard]] SmallMatrix congruence(const MatrixView& f, const MatrixView& p);
/// s A + t B.
[[nodiscard]] SmallMatrix combination(double s, const MatrixView& a, double t, const MatrixView& b);
/// A above B.
[[nodiscard]] SmallMatrix stacked(const MatrixView& a, const MatrixView& b);

[[nodiscard]] SmallMatrix approximate_inverse(const MatrixView& a);
/// The solution of S X = B, S symmetric.
[[nodiscard]] SmallMatrix symmetric_solution(const MatrixView& s, const MatrixView& b);

/// L with L L' = S for a symmetric S, whose lower triangle is read; nothing where S is not positive definite.
[[nodiscard]] std::optional<SmallMatrix> cholesky(const MatrixView& s);
/// L^-1 B for a lower triangle L.
[[nodiscard]] SmallMatrix lower_solution(const SmallMatrix& l, const MatrixView& b);
/// L^-1 S L^-T for a symmetric S: S in units of L L'.
[[nodiscard]] SmallMatrix in_units_of(const SmallMatrix& l, const MatrixView& s);

}  // namespace veritrack::rigor
