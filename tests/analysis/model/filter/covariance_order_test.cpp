#include "analysis/model/filter/covariance_order.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::BallModel;

Eigen::MatrixXd random_matrix(test::Random& random, Eigen::Index n, double size) {
  return Eigen::MatrixXd::NullaryExpr(n, n, [&] { return random.uniform(-size, size); });
}

BallMatrix constant(const Eigen::MatrixXd& matrix) {
  BallMatrix result(static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols()));
  for (std::size_t i = 0; i < result.rows(); ++i) {
    for (std::size_t j = 0; j < result.columns(); ++j) {
      result(i, j) = BallModel(matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
  return result;
}

TEST_CASE("what is shown of F P F' holds for random xi") {
  test::Random random(81);
  int shown = 0;
  for (int i = 0; i < 40; ++i) {
    const Eigen::MatrixXd f = random_matrix(random, 2, 1.0);
    const Eigen::MatrixXd first = random_matrix(random, 2, 0.1);
    const Eigen::MatrixXd second = random_matrix(random, 2, 0.1);
    const Eigen::MatrixXd of_product = random_matrix(random, 2, 0.05);
    const Eigen::MatrixXd root = random_matrix(random, 2, 1.0);
    const Eigen::MatrixXd p = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(2, 2);
    const Eigen::MatrixXd q = 0.5 * Eigen::MatrixXd::Identity(2, 2);
    // F = f + first x0 + second x1 + of_product x0 x1.
    std::vector<BallModel> jacobian;
    const rigor::BallModelScope scope(2, 0);
    for (Eigen::Index row = 0; row < 2; ++row) {
      for (Eigen::Index column = 0; column < 2; ++column) {
        jacobian.push_back(BallModel(f(row, column)) + BallModel(first(row, column)) * BallModel::ball(0) +
                           BallModel(second(row, column)) * BallModel::ball(1) +
                           BallModel(of_product(row, column)) * BallModel::ball(0) * BallModel::ball(1));
      }
    }
    const rigor::BallModelScope plane(0, 0);
    const JacobianParts parts = parts_of_jacobian(jacobian, 2);
    const double size = (f * p * f.transpose()).trace();
    for (const double share : {0.05, 0.2, 0.6}) {
      const Eigen::MatrixXd high =
          f * p * f.transpose() + q + share * (size + 0.1) * Eigen::MatrixXd::Identity(2, 2);
      const Eigen::MatrixXd low =
          f * p * f.transpose() + q - share * (size + 0.1) * Eigen::MatrixXd::Identity(2, 2);
      const bool is_below = stays_below(parts, constant(p), constant(q), constant(high));
      const bool is_above =
          oracle::least_eigenvalue(low) > 0.0 && stays_above(parts, constant(p), constant(q), constant(low));
      shown += (is_below ? 1 : 0) + (is_above ? 1 : 0);
      for (int k = 0; k < 50; ++k) {
        Eigen::Vector2d x(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
        x /= std::max(1.0, x.norm());
        const Eigen::MatrixXd here = f + first * x[0] + second * x[1] + of_product * x[0] * x[1];
        const Eigen::MatrixXd next = here * p * here.transpose() + q;
        CHECK((!is_below || oracle::least_eigenvalue(high - next) > 0.0));
        CHECK((!is_above || oracle::least_eigenvalue(next - low) > 0.0));
      }
    }
    CHECK_FALSE(stays_below(parts, constant(p), constant(q), constant(f * p * f.transpose() + q)));
    CHECK_FALSE(stays_above(parts, constant(p), constant(q), constant(f * p * f.transpose() + q)));
  }
  CHECK(shown > 60);
}

}  // namespace
}  // namespace veritrack::model
