#include "analysis/rigor/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <stdexcept>

namespace veritrack::rigor {

namespace {

SmallMatrix small(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  if (matrix.rows() > kMostSmallRows || matrix.rows() != matrix.cols()) {
    throw std::length_error("an eigensystem is found of square matrices of up to 20 rows");
  }
  return matrix;
}

/// The function of the eigenvalues of a symmetric matrix.
template <typename Function>
double of_values(const Eigen::Ref<const Eigen::MatrixXd>& symmetric, const Function& function) {
  if (symmetric.rows() <= kMostSmallRows) {
    return function(
        Eigen::SelfAdjointEigenSolver<SmallMatrix>(symmetric, Eigen::EigenvaluesOnly).eigenvalues());
  }
  return function(
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues());
}

}  // namespace

double largest_eigenvalue(const Eigen::Ref<const Eigen::MatrixXd>& symmetric) {
  return of_values(symmetric, [](const auto& values) { return values.maxCoeff(); });
}

double least_eigenvalue(const Eigen::Ref<const Eigen::MatrixXd>& symmetric) {
  return of_values(symmetric, [](const auto& values) { return values.minCoeff(); });
}

double largest_absolute_eigenvalue(const Eigen::Ref<const Eigen::MatrixXd>& symmetric) {
  return of_values(symmetric, [](const auto& values) { return values.cwiseAbs().maxCoeff(); });
}

Eigen::MatrixXd symmetric_eigenvectors(const Eigen::Ref<const Eigen::MatrixXd>& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvectors();
}

Eigen::MatrixXd pencil_eigenvectors(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                    const Eigen::Ref<const Eigen::MatrixXd>& b) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(a, b).eigenvectors();
}

Eigensystem symmetric_eigensystem(const Eigen::Ref<const Eigen::MatrixXd>& symmetric) {
  const Eigen::SelfAdjointEigenSolver<SmallMatrix> solver(small(symmetric));
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigensystem pencil_eigensystem(const Eigen::Ref<const Eigen::MatrixXd>& a,
                               const Eigen::Ref<const Eigen::MatrixXd>& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<SmallMatrix> solver(small(a), small(b));
  return {solver.eigenvalues(), solver.eigenvectors()};
}

double spectral_radius(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  return small(matrix).eigenvalues().cwiseAbs().maxCoeff();
}

double largest_argument(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  return small(matrix).eigenvalues().cwiseArg().cwiseAbs().maxCoeff();
}

DominantMode dominant_mode(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  const Eigen::EigenSolver<SmallMatrix> solver(small(matrix));
  Eigen::Index place = 0;
  const double radius = solver.eigenvalues().cwiseAbs().maxCoeff(&place);
  // Of a pair of complex eigenvectors only the sizes of the entries have a meaning.
  const bool is_real = solver.eigenvalues()[place].imag() == 0.0;
  const Eigen::VectorXcd vector = solver.eigenvectors().col(place);
  return {radius, is_real ? Eigen::VectorXd(vector.real()) : Eigen::VectorXd(vector.cwiseAbs())};
}

}  // namespace veritrack::rigor
