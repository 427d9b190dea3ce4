#include "analysis/rigor/spectral_radius.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace veritrack::rigor {

namespace {

SmallMatrix small_square(const MatrixView& matrix) {
  if (matrix.rows() > kMostSmallRows || matrix.rows() != matrix.cols()) {
    throw std::length_error("the spectral radius is found of square matrices of up to 20 rows");
  }
  return matrix;
}

}  // namespace

double spectral_radius(const MatrixView& matrix) {
  return small_square(matrix).eigenvalues().cwiseAbs().maxCoeff();
}

std::vector<std::complex<double>> eigenvalues_by_size(const MatrixView& matrix) {
  const auto found = small_square(matrix).eigenvalues();
  std::vector<std::complex<double>> sorted(found.begin(), found.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    const double difference = std::abs(a) - std::abs(b);
    return std::fabs(difference) > 1e-9 * std::abs(a) ? difference > 0.0 : a.imag() > b.imag();
  });
  return sorted;
}

double largest_argument(const MatrixView& matrix) {
  return small_square(matrix).eigenvalues().cwiseArg().cwiseAbs().maxCoeff();
}

DominantMode dominant_mode(const MatrixView& matrix) {
  const Eigen::EigenSolver<SmallMatrix> solver(small_square(matrix));
  Eigen::Index place = 0;
  const double radius = solver.eigenvalues().cwiseAbs().maxCoeff(&place);
  // Only the sizes of the entries of a pair of complex eigenvectors have a meaning.
  const bool is_real = solver.eigenvalues()[place].imag() == 0.0;
  const Eigen::VectorXcd vector = solver.eigenvectors().col(place);
  return {radius, is_real ? Eigen::VectorXd(vector.real()) : Eigen::VectorXd(vector.cwiseAbs())};
}

}  // namespace veritrack::rigor
