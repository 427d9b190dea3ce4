// Symmetric matrices of balls: definiteness, congruence, inverse, eigenvalues.
#pragma once

#include <array>

#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

template <std::size_t Size>
using SquareMatrix = std::array<std::array<Ball, Size>, Size>;

/// True only when every symmetric matrix whose lower triangle is in the balls is positive definite: the
/// pivots of each lie in the balls found.
template <std::size_t Size>
bool definite(SquareMatrix<Size> m CHECKER_PLACE) {
  CHECKER_IF_FORCED
  for (std::size_t k = 0; k < Size; ++k) {
    if (!certainly_positive(m[k][k])) {
      return false;
    }
    for (std::size_t i = k + 1; i < Size; ++i) {
      const Ball factor = m[i][k] / m[k][k];
      for (std::size_t j = k + 1; j <= i; ++j) {
        m[i][j] -= factor * m[j][k];
      }
    }
  }
  return true;
}

using Matrix3 = SquareMatrix<3>;

Matrix3 operator+(const Matrix3& x, const Matrix3& y);
Matrix3 operator-(const Matrix3& x, const Matrix3& y);
Matrix3 scaled(const Ball& factor, Matrix3 p);
/// Entries across the diagonal are the same exact number.
bool symmetric(const Matrix3& p);
Matrix3 diagonal(const Ball& x, const Ball& y, const Ball& z);
/// A P A' for a symmetric P.
Matrix3 congruent(const Matrix3& a, const Matrix3& p);
/// By the adjugate; balls of everything when the determinant may be zero.
Matrix3 inverse(const Matrix3& p);
/// All eigenvalues are between these two, which are the smallest and the largest.
Range extreme_eigenvalues(const Matrix3& p);
/// The larger eigenvalue of [[a, b], [b, c]].
Ball larger_eigenvalue(const Ball& a, const Ball& b, const Ball& c);

}  // namespace veritrack::checker
