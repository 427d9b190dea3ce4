// Decompositions of matrices of doubles, for proposals: Eigen's, behind plain functions so that each is
// compiled once, which takes half a minute. Nothing here is evidence; rounding is the caller's.
#pragma once

#include <Eigen/Core>

namespace veritrack::rigor {

/// Matrices of at most this many rows need no allocation.
inline constexpr int kMostSmallRows = 20;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostSmallRows, kMostSmallRows>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostSmallRows, 1>;

/// Of a symmetric matrix, whose lower triangle is read. The result is arbitrary where an entry is not finite.
[[nodiscard]] double largest_eigenvalue(const Eigen::Ref<const Eigen::MatrixXd>& symmetric);
[[nodiscard]] double least_eigenvalue(const Eigen::Ref<const Eigen::MatrixXd>& symmetric);
/// The largest |eigenvalue|.
[[nodiscard]] double largest_absolute_eigenvalue(const Eigen::Ref<const Eigen::MatrixXd>& symmetric);

/// The eigenvectors of a symmetric matrix of any size, of length 1, a column for each, by ascending
/// eigenvalue.
[[nodiscard]] Eigen::MatrixXd symmetric_eigenvectors(const Eigen::Ref<const Eigen::MatrixXd>& symmetric);
/// Those of A v = t B v, B positive definite; v'B v = 1.
[[nodiscard]] Eigen::MatrixXd pencil_eigenvectors(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                                  const Eigen::Ref<const Eigen::MatrixXd>& b);

/// These take matrices of up to kMostSmallRows rows, and throw std::length_error for others.
struct Eigensystem {
  SmallVector values;   ///< ascending
  SmallMatrix vectors;  ///< a column for each, of length 1
};
[[nodiscard]] Eigensystem symmetric_eigensystem(const Eigen::Ref<const Eigen::MatrixXd>& symmetric);
/// Of A v = t B v, B positive definite; v'B v = 1.
[[nodiscard]] Eigensystem pencil_eigensystem(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                             const Eigen::Ref<const Eigen::MatrixXd>& b);

/// The largest |eigenvalue| of a square matrix.
[[nodiscard]] double spectral_radius(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/// The largest |argument| of an eigenvalue, radians.
[[nodiscard]] double largest_argument(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/// The eigenvalue of the largest size, and its eigenvector v, A v = t v: of a pair of complex ones the sizes
/// of the entries.
struct DominantMode {
  double radius;
  Eigen::VectorXd vector;
};
[[nodiscard]] DominantMode dominant_mode(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

}  // namespace veritrack::rigor
