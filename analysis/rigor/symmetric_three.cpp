#include "analysis/rigor/symmetric_three.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>

namespace veritrack::rigor {

ThreeEigensystem eigensystem_of_three(const Matrix<3>& symmetric) {
  Eigen::SelfAdjointEigenSolver<Matrix<3>> solver;
  solver.computeDirect(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

ThreeEigensystem pencil_of_three(const Matrix<3>& a, const Matrix<3>& b) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix<3>> solver(a, b);
  if (solver.info() != Eigen::Success) {
    return {Vector<3>::Constant(kNaN), Matrix<3>::Constant(kNaN)};
  }
  return {solver.eigenvalues(), solver.eigenvectors()};
}

std::optional<Matrix<3>> cholesky_of_three(const Matrix<3>& symmetric) {
  const Eigen::LLT<Matrix<3>> root(symmetric);
  const Matrix<3> lower = root.matrixL();
  // Eigen takes a pivot that is not a number for a positive one.
  return root.info() == Eigen::Success && lower.allFinite() ? std::optional(lower) : std::nullopt;
}

double least_eigenvalue_in_units(const Matrix<3>& l, const Matrix<3>& symmetric) {
  const auto lower = l.triangularView<Eigen::Lower>();
  const Matrix<3> half = lower.solve(symmetric);
  const Matrix<3> whole = lower.solve(half.transpose());
  Eigen::SelfAdjointEigenSolver<Matrix<3>> solver;
  solver.computeDirect(whole, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0];
}

}  // namespace veritrack::rigor
