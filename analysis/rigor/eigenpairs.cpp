#include "analysis/rigor/eigenpairs.hpp"

#include <Eigen/Eigenvalues>

namespace veritrack::rigor {

Eigenpairs eigenpairs(const Eigen::MatrixXd& matrix) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace veritrack::rigor
