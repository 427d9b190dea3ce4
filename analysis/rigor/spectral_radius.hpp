// Eigenvalues of square matrices of doubles of up to kMostSmallRows rows, for proposals: see
// symmetric_eigensystem.hpp. Others throw std::length_error.
#pragma once

#include <complex>
#include <vector>

#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::rigor {

/// The largest |eigenvalue| of a square matrix.
[[nodiscard]] double spectral_radius(const MatrixView& matrix);

/// The eigenvalues, the largest first; of a pair the one with the positive imaginary part first.
[[nodiscard]] std::vector<std::complex<double>> eigenvalues_by_size(const MatrixView& matrix);

/// The largest |argument| of an eigenvalue, radians.
[[nodiscard]] double largest_argument(const MatrixView& matrix);

/// The eigenvalue of the largest size, and its eigenvector v, A v = t v: of a pair of complex ones the sizes
/// of the entries.
struct DominantMode {
  double radius;
  Eigen::VectorXd vector;
};
[[nodiscard]] DominantMode dominant_mode(const MatrixView& matrix);

}  // namespace veritrack::rigor
