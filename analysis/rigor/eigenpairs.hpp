// Eigenvalues and eigenvectors of a square matrix of doubles of any size, for proposals: see
// small_matrix.hpp.
#pragma once

#include <Eigen/Core>

namespace veritrack::rigor {

struct Eigenpairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  ///< column j belongs to value j; of length 1
};
[[nodiscard]] Eigenpairs eigenpairs(const Eigen::MatrixXd& matrix);

}  // namespace veritrack::rigor
