// Eigenvalues of symmetric matrices of doubles, for proposals: Eigen's, behind plain functions so that each
// is compiled once, which takes many seconds. Nothing here is evidence; rounding is the caller's.
#pragma once

#include <Eigen/Core>

#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::rigor {

/// Eigenvalues of a symmetric matrix, whose lower triangle is read. The result is arbitrary where an entry is
/// not finite.
[[nodiscard]] double largest_eigenvalue(const MatrixView& symmetric);
[[nodiscard]] double least_eigenvalue(const MatrixView& symmetric);
/// The largest |eigenvalue|.
[[nodiscard]] double largest_absolute_eigenvalue(const MatrixView& symmetric);

/// The eigenvectors of a symmetric matrix of any size, of length 1, a column for each, by ascending
/// eigenvalue.
[[nodiscard]] Eigen::MatrixXd symmetric_eigenvectors(const MatrixView& symmetric);
/// Those of A v = t B v, B positive definite; v'B v = 1.
[[nodiscard]] Eigen::MatrixXd pencil_eigenvectors(const MatrixView& a, const MatrixView& b);

/// These take matrices of up to kMostSmallRows rows, and throw std::length_error for others.
struct Eigensystem {
  SmallVector values;   ///< ascending
  SmallMatrix vectors;  ///< a column for each, of length 1
};
[[nodiscard]] Eigensystem symmetric_eigensystem(const MatrixView& symmetric);
/// The eigensystem of A v = t B v, B positive definite; v'B v = 1.
[[nodiscard]] Eigensystem pencil_eigensystem(const MatrixView& a, const MatrixView& b);

}  // namespace veritrack::rigor
