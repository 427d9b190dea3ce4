// The other half, so that two are compiled side by side: matrices that need not be symmetric.
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "tests/support/oracles.hpp"

namespace veritrack::oracle {

Eigen::VectorXcd eigenvalues(const AnyMatrix& matrix) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
}

double spectral_radius(const AnyMatrix& matrix) {
  return eigenvalues(matrix).cwiseAbs().maxCoeff();
}

Eigen::VectorXd singular_values(const AnyMatrix& matrix) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues();
}

Eigen::Matrix<long double, 3, 1> singular_values(const AnyWideMatrix3& matrix) {
  return Eigen::JacobiSVD<WideMatrix3>(matrix).singularValues();
}

WideMatrix3 right_singular_vectors(const WideMatrix3& matrix) {
  return Eigen::JacobiSVD<WideMatrix3>(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV).matrixV();
}

Eigen::Index rank(const AnyMatrix& matrix) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).rank();
}

Eigen::MatrixXd orthogonal_factor(const AnyMatrix& matrix) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(matrix, Eigen::ComputeFullU).matrixU();
}

Eigen::VectorXd least_squares(const AnyMatrix& matrix, const Eigen::VectorXd& right) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV).solve(right);
}

}  // namespace veritrack::oracle
