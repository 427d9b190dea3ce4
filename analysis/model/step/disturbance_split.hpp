// The best split of a bound on a sum of vectors among them: proposals in floating point. Any split is valid.
#pragma once

#include <Eigen/Core>
#include <array>

namespace veritrack::model {

/// The t in (0, 1) that makes the largest eigenvalue of x/t + v/(1 - t) least; symmetric matrices, positive
/// semidefinite. 1/2 when one has no rows.
[[nodiscard]] double proposed_split(const Eigen::MatrixXd& x, const Eigen::MatrixXd& v);

/// Positive weights: their shares t of the sum make the largest eigenvalue of x/t1 + v/t2 + w/t3 least. Equal
/// ones when a matrix has no rows.
[[nodiscard]] std::array<double, 3> proposed_shares(const Eigen::MatrixXd& x, const Eigen::MatrixXd& v,
                                                    const Eigen::MatrixXd& w);

}  // namespace veritrack::model
