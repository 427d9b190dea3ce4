// Bounds on eigenvalues against matrices whose eigenvalues are known.
#include "checker/model/symmetric_matrix.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

SymmetricMatrix from_eigen(const Eigen::MatrixXd& a) {
  SymmetricMatrix matrix(static_cast<std::size_t>(a.rows()));
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      matrix.add(static_cast<std::size_t>(i), static_cast<std::size_t>(j), a(i, j));
    }
  }
  return matrix;
}

TEST_CASE("the largest eigenvalue, bounded from above and not by much") {
  test::Random random(91);
  for (std::int64_t trial = 0; trial < test::effort(500); ++trial) {
    const auto n = static_cast<Eigen::Index>(1 + random.below(9));
    Eigen::MatrixXd root(n, n);
    for (double& entry : root.reshaped()) {
      entry = random.uniform(-1.0, 1.0);
    }
    const double scale = std::pow(10.0, random.uniform(-20.0, 20.0));
    const Eigen::MatrixXd a = scale * (root * root.transpose());
    const Eigen::MatrixXd symmetric = 0.5 * (a + a.transpose());
    const double largest = oracle::largest_eigenvalue(symmetric);
    const SymmetricMatrix matrix = from_eigen(symmetric);
    REQUIRE(near_largest_eigenvalue(matrix) == doctest::Approx(largest).epsilon(1e-10));
    REQUIRE(eigenvalue_bound(matrix) >= largest * (1.0 - 1e-14));
    REQUIRE(eigenvalue_bound(matrix) <= largest * (1.0 + 1e-8));
    REQUIRE(certainly_bounded(matrix, largest * (1.0 + 1e-11)));
    REQUIRE_FALSE(certainly_bounded(matrix, largest * (1.0 - 1e-13)));
    REQUIRE_FALSE(certainly_bounded(matrix, 0.5 * largest));
    // Not only of semidefinite ones.
    const SymmetricMatrix negative = from_eigen(-symmetric);
    REQUIRE_FALSE(certainly_bounded(negative, -largest * (1.0 + 1e-12)));
    REQUIRE(certainly_bounded(negative, 1e-6 * largest));
  }
}

TEST_CASE("nothing is bounded by what is not finite") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    SymmetricMatrix matrix(2);
    matrix.add(0, 0, 1.0);
    matrix.add(1, 1, 1.0);
    CHECK_FALSE(certainly_bounded(matrix, bad));
    SymmetricMatrix off = matrix;
    off.add(1, 0, bad);
    CHECK_FALSE(certainly_bounded(off, 10.0));
    CHECK_FALSE(std::isfinite(eigenvalue_bound(off)));
    matrix.add(1, 1, bad);
    CHECK_FALSE(certainly_bounded(matrix, 10.0));
    CHECK_FALSE(std::isfinite(eigenvalue_bound(matrix)));
  }
  CHECK_FALSE(certainly_bounded(SymmetricMatrix(0), 1.0));
  CHECK_FALSE(certainly_bounded(SymmetricMatrix(2), 0.0));
  CHECK(certainly_bounded(SymmetricMatrix(2), 1.0));
  CHECK_FALSE(certainly_bounded(SymmetricMatrix(2), -1.0));
}

}  // namespace
}  // namespace veritrack::checker
