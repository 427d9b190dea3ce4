#include "analysis/rigor/small_matrix.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

#include "tests/support/random.hpp"

namespace veritrack::rigor {
namespace {

/// Entry by entry, row times column.
Eigen::MatrixXd multiplied(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd result(a.rows(), b.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      result(i, j) = 0.0;
      for (Eigen::Index k = 0; k < a.cols(); ++k) {
        result(i, j) += a(i, k) * b(k, j);
      }
    }
  }
  return result;
}

TEST_CASE("products and solutions of random matrices satisfy their equations") {
  test::Random random(3602);
  const auto drawn = [&](int rows, int columns) {
    return Eigen::MatrixXd(
        Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.uniform(-1.0, 1.0); }));
  };
  for (int n = 1; n <= kMostSmallRows; ++n) {
    CAPTURE(n);
    const Eigen::MatrixXd a = drawn(n, n);
    const Eigen::MatrixXd b = drawn(n, 3);
    const Eigen::MatrixXd s = multiplied(a, a.transpose()) + Eigen::MatrixXd::Identity(n, n);
    CHECK((product(a, b) - multiplied(a, b)).norm() < 1e-13 * n);
    CHECK((product_with_transpose(a, transposed(b)) - multiplied(a, b)).norm() < 1e-13 * n);
    CHECK((congruence(a, s) - multiplied(multiplied(a, s), a.transpose())).norm() < 1e-11 * n);
    CHECK(combination(2.0, a, -3.0, s)(n - 1, 0) == doctest::Approx(2.0 * a(n - 1, 0) - 3.0 * s(n - 1, 0)));
    CHECK((multiplied(s, approximate_inverse(s)) - Eigen::MatrixXd::Identity(n, n)).norm() < 1e-12 * n);
    CHECK((multiplied(s, symmetric_solution(s, b)) - b).norm() < 1e-12 * n);
    const auto root = cholesky(s);
    REQUIRE(root);
    CHECK((multiplied(*root, root->transpose()) - s).norm() < 1e-12 * n);
    CHECK((n == 1 || (*root)(0, n - 1) == 0.0));
    CHECK((multiplied(*root, lower_solution(*root, b)) - b).norm() < 1e-12 * n);
    CHECK((congruence(*root, in_units_of(*root, a + a.transpose())) - a - a.transpose()).norm() < 1e-11 * n);
  }
  const SmallMatrix both = stacked(drawn(2, 3), identity(3));
  CHECK(both.rows() == 5);
  CHECK(both(4, 2) == 1.0);
}

TEST_CASE("a matrix that is not positive definite has no root") {
  Eigen::Matrix2d matrix;
  matrix << 1.0, 2.0, 2.0, 1.0;
  CHECK_FALSE(cholesky(matrix));
  matrix << 1.0, 0.0, 0.0, std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(cholesky(matrix));
}

TEST_CASE("a result that is not small is refused") {
  const Eigen::MatrixXd large = Eigen::MatrixXd::Identity(21, 2);
  CHECK_THROWS_AS(static_cast<void>(product_with_transpose(large, large)), std::length_error);
  CHECK_THROWS_AS(static_cast<void>(transposed(large)), std::length_error);
  CHECK_THROWS_AS(static_cast<void>(stacked(identity(20), identity(20))), std::length_error);
  CHECK_THROWS_AS(static_cast<void>(identity(21)), std::length_error);
}

}  // namespace
}  // namespace veritrack::rigor
