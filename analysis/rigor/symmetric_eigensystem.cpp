#include "analysis/rigor/symmetric_eigensystem.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>
#include <stdexcept>

namespace veritrack::rigor {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

SmallMatrix small_symmetric(const MatrixView& matrix) {
  if (matrix.rows() > kMostSmallRows || matrix.rows() != matrix.cols()) {
    throw std::length_error("an eigensystem is found of square matrices of up to 20 rows");
  }
  return matrix;
}

/// The function of the eigenvalues of a symmetric matrix.
template <typename Function>
double of_values(const MatrixView& symmetric, const Function& function) {
  if (symmetric.rows() <= kMostSmallRows) {
    return function(
        Eigen::SelfAdjointEigenSolver<SmallMatrix>(symmetric, Eigen::EigenvaluesOnly).eigenvalues());
  }
  return function(
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues());
}

}  // namespace

double largest_eigenvalue(const MatrixView& symmetric) {
  return of_values(symmetric, [](const auto& values) { return values.maxCoeff(); });
}

double least_eigenvalue(const MatrixView& symmetric) {
  return of_values(symmetric, [](const auto& values) { return values.minCoeff(); });
}

double largest_absolute_eigenvalue(const MatrixView& symmetric) {
  return of_values(symmetric, [](const auto& values) { return values.cwiseAbs().maxCoeff(); });
}

Eigen::MatrixXd symmetric_eigenvectors(const MatrixView& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvectors();
}

Eigen::MatrixXd pencil_eigenvectors(const MatrixView& a, const MatrixView& b) {
  // With B = L L' those of L^-1 A L^-T, times L^-T.
  const Eigen::LLT<Eigen::MatrixXd> root(b);
  Eigen::MatrixXd reduced = a;
  root.matrixL().solveInPlace(reduced);
  reduced.transposeInPlace();
  root.matrixL().solveInPlace(reduced);
  Eigen::MatrixXd vectors = symmetric_eigenvectors(reduced);
  root.matrixU().solveInPlace(vectors);
  return vectors;
}

Eigensystem symmetric_eigensystem(const MatrixView& symmetric) {
  const Eigen::SelfAdjointEigenSolver<SmallMatrix> solver(small_symmetric(symmetric));
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigensystem pencil_eigensystem(const MatrixView& a, const MatrixView& b) {
  const auto root = cholesky(small_symmetric(b));
  if (!root) {
    return {SmallVector::Constant(a.rows(), kNaN), SmallMatrix::Constant(a.rows(), a.rows(), kNaN)};
  }
  Eigensystem system = symmetric_eigensystem(in_units_of(*root, small_symmetric(a)));
  root->triangularView<Eigen::Lower>().transpose().solveInPlace(system.vectors);
  return system;
}

}  // namespace veritrack::rigor
