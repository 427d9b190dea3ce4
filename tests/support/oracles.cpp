#include "tests/support/oracles.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace veritrack::oracle {
namespace {

template <typename Matrix>
using SymmetricSolver = Eigen::SelfAdjointEigenSolver<Matrix>;

}  // namespace

Eigen::VectorXd symmetric_eigenvalues(const AnyMatrix& matrix) {
  if (matrix.rows() == 3) {  // as most have, and for which Eigen has a shorter way
    return SymmetricSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  }
  return SymmetricSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::Matrix<long double, 3, 1> symmetric_eigenvalues(const AnyWideMatrix3& matrix) {
  return SymmetricSolver<WideMatrix3>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

double least_eigenvalue(const AnyMatrix& matrix) {
  return symmetric_eigenvalues(matrix)(0);
}

double largest_eigenvalue(const AnyMatrix& matrix) {
  return symmetric_eigenvalues(matrix)(matrix.rows() - 1);
}

Eigen::Matrix3d symmetric_eigenvectors(const Eigen::Matrix3d& matrix) {
  return SymmetricSolver<Eigen::Matrix3d>(matrix).eigenvectors();
}

Eigen::Vector3d relative_eigenvalues(const Eigen::Matrix3d& matrix, const Eigen::Matrix3d& bound) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, bound).eigenvalues();
}

long double relative_radius(const WideMatrix3& matrix, const WideMatrix3& bound) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<WideMatrix3> solver(matrix, bound);
  return solver.eigenvalues().cwiseAbs().maxCoeff();
}

Eigen::Matrix3d cholesky_factor(const Eigen::Matrix3d& matrix) {
  return Eigen::LLT<Eigen::Matrix3d>(matrix).matrixL();
}

Eigen::MatrixXd solution(const AnyMatrix& matrix, const AnyMatrix& right) {
  return Eigen::PartialPivLU<Eigen::MatrixXd>(matrix).solve(Eigen::MatrixXd(right));
}

Eigen::VectorXcd solution(const AnyComplexMatrix& matrix, const Eigen::Ref<const Eigen::VectorXcd>& right) {
  const Eigen::Index n = matrix.rows();
  Eigen::MatrixXd parts(2 * n, 2 * n);
  parts << matrix.real(), -matrix.imag(), matrix.imag(), matrix.real();
  Eigen::VectorXd sides(2 * n);
  sides << right.real(), right.imag();
  const Eigen::VectorXd found = solution(parts, sides);
  Eigen::VectorXcd result(n);
  result.real() = found.head(n);
  result.imag() = found.tail(n);
  return result;
}

Eigen::MatrixXd inverse(const AnyMatrix& matrix) {
  return solution(matrix, Eigen::MatrixXd::Identity(matrix.rows(), matrix.rows()));
}

DynamicWideMatrix inverse(const Eigen::Ref<const DynamicWideMatrix>& matrix) {
  return DynamicWideMatrix(matrix).inverse();
}

double determinant(const AnyMatrix& matrix) {
  return Eigen::PartialPivLU<Eigen::MatrixXd>(matrix).determinant();
}

}  // namespace veritrack::oracle
