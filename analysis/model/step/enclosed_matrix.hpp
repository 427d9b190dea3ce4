// Products of matrices of doubles with bounds on rounding errors, and verified bounds of eigenvalues.
#pragma once

#include <Eigen/Core>

#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// A matrix that is known up to an error: `middle`, and a bound of the Frobenius norm of the difference. All
/// functions need the upward rounding mode.
struct EnclosedMatrix {
  Eigen::MatrixXd middle;
  double error = 0.0;
};

/// An upper bound of the relative error of an entry per operation, generously.
inline constexpr double kUnitOfProducts = 0x1p-50;

/// The Frobenius norm, rounded up.
[[nodiscard]] double frobenius(const Eigen::MatrixXd& matrix);

/// A B', of exact matrices.
[[nodiscard]] EnclosedMatrix enclosed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// sum += factor matrix, for a positive factor.
void add_multiple(EnclosedMatrix& sum, const EnclosedMatrix& matrix, const rigor::Interval& factor);

/// An upper bound of the largest absolute eigenvalue of a symmetric matrix: |G| <= |G^4|_F^(1/4). NaN when
/// nothing is known.
[[nodiscard]] double norm_of_symmetric(const EnclosedMatrix& matrix);

/// An upper bound of the largest eigenvalue of a symmetric matrix, proposed in floating point and verified.
/// NaN when nothing is known.
[[nodiscard]] double largest_eigenvalue(const EnclosedMatrix& matrix);

}  // namespace veritrack::model
