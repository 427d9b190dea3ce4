// What tests compare with: decompositions by Eigen alone, compiled once. They cost seconds wherever they
// stand.
#pragma once

#include <Eigen/Core>

namespace veritrack::oracle {

using AnyMatrix = Eigen::Ref<const Eigen::MatrixXd>;
using WideMatrix3 = Eigen::Matrix<long double, 3, 3>;
using AnyComplexMatrix = Eigen::Ref<const Eigen::MatrixXcd>;
using DynamicWideMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using AnyWideMatrix3 = Eigen::Ref<const WideMatrix3>;

/// Of the lower triangle, in ascending order.
Eigen::VectorXd symmetric_eigenvalues(const AnyMatrix& matrix);
Eigen::Matrix<long double, 3, 1> symmetric_eigenvalues(const AnyWideMatrix3& matrix);
double least_eigenvalue(const AnyMatrix& matrix);
double largest_eigenvalue(const AnyMatrix& matrix);
/// In the order of their eigenvalues, a column each.
Eigen::Matrix3d symmetric_eigenvectors(const Eigen::Matrix3d& matrix);
/// The l with matrix v = l bound v, for a positive definite bound, in ascending order.
Eigen::Vector3d relative_eigenvalues(const Eigen::Matrix3d& matrix, const Eigen::Matrix3d& bound);
/// The largest of them in size.
long double relative_radius(const WideMatrix3& matrix, const WideMatrix3& bound);
/// L with L L' = matrix, of a positive definite matrix.
Eigen::Matrix3d cholesky_factor(const Eigen::Matrix3d& matrix);

/// Of a square matrix, in no order.
Eigen::VectorXcd eigenvalues(const AnyMatrix& matrix);
double spectral_radius(const AnyMatrix& matrix);

/// In descending order.
Eigen::VectorXd singular_values(const AnyMatrix& matrix);
Eigen::Matrix<long double, 3, 1> singular_values(const AnyWideMatrix3& matrix);
/// In the order of their singular values, a column each.
WideMatrix3 right_singular_vectors(const WideMatrix3& matrix);
Eigen::Index rank(const AnyMatrix& matrix);
/// Some orthogonal matrix, a random one for a random argument: the left singular vectors.
Eigen::MatrixXd orthogonal_factor(const AnyMatrix& matrix);
/// The x with the least |matrix x - right|.
Eigen::VectorXd least_squares(const AnyMatrix& matrix, const Eigen::VectorXd& right);

/// The x with matrix x = right.
Eigen::MatrixXd solution(const AnyMatrix& matrix, const AnyMatrix& right);
Eigen::VectorXcd solution(const AnyComplexMatrix& matrix, const Eigen::Ref<const Eigen::VectorXcd>& right);
/// Of five rows or more, or of any number. Up to four, Eigen's own for matrices of fixed size are short
/// formulas.
Eigen::MatrixXd inverse(const AnyMatrix& matrix);
DynamicWideMatrix inverse(const Eigen::Ref<const DynamicWideMatrix>& matrix);
double determinant(const AnyMatrix& matrix);

}  // namespace veritrack::oracle
