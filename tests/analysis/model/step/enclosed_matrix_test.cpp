#include "analysis/model/step/enclosed_matrix.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using rigor::Interval;
using rigor::UpwardRounding;

/// long double has 11 bits more than double: its sums of a few products are exact enough to judge by.
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

MatrixXd random_enclosed(test::Random& random, Index rows, Index columns) {
  // Of very different sizes.
  return MatrixXd::NullaryExpr(rows, columns, [&] {
    return std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.below(20)) - 10);
  });
}

/// |matrix - middle| <= error.
bool encloses(const EnclosedMatrix& enclosed, const LongMatrix& matrix) {
  return (matrix - enclosed.middle.cast<long double>()).norm() <= static_cast<long double>(enclosed.error);
}

TEST_CASE("norms are rounded up, and hardly") {
  const UpwardRounding upward;
  test::Random random(60);
  for (int trial = 0; trial < 100; ++trial) {
    const MatrixXd matrix = random_enclosed(random, 4, 3);
    const long double exact = matrix.cast<long double>().norm();
    CHECK(static_cast<long double>(frobenius(matrix)) >= exact);
    CHECK(static_cast<long double>(frobenius(matrix)) <= exact * (1.0L + 1e-14L));
  }
  CHECK(frobenius(MatrixXd::Zero(2, 2)) < 1e-280);
}

TEST_CASE("products and sums enclose the exact ones, with small errors") {
  const UpwardRounding upward;
  test::Random random(61);
  for (int trial = 0; trial < 200; ++trial) {
    const MatrixXd a = random_enclosed(random, 3, 5);
    const MatrixXd b = random_enclosed(random, 2, 5);
    const LongMatrix exact = a.cast<long double>() * b.cast<long double>().transpose();
    EnclosedMatrix product = enclosed_product(a, b);
    CHECK(encloses(product, exact));
    CHECK(product.error <= 1e-13 * frobenius(a) * frobenius(b));
    // sum + factor matrix for the ends of the factor, whose matrix is known up to its error.
    const EnclosedMatrix other{random_enclosed(random, 3, 2), 0.001};
    const double factor = random.uniform(0.1, 2.0);
    const Interval range = Interval::from_bounds(factor, factor * 1.01);
    add_multiple(product, other, range);
    LongMatrix moved = other.middle.cast<long double>();
    moved(0, 0) += 0.001L;  // as far as it may be off
    for (const double end : {range.lower(), range.upper()}) {
      CHECK(encloses(product, exact + static_cast<long double>(end) * moved));
    }
  }
}

/// A symmetric matrix with these eigenvalues.
MatrixXd with_eigenvalues(test::Random& random, const Eigen::Vector3d& values) {
  const Eigen::Quaterniond turn(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  const MatrixXd q = turn.normalized().toRotationMatrix();
  return q * values.asDiagonal() * q.transpose();
}

TEST_CASE("eigenvalues of matrices that were made of them are bounded from above, and well") {
  test::Random random(62);
  for (int trial = 0; trial < 100; ++trial) {
    const double largest = std::ldexp(random.uniform(0.5, 1.0), static_cast<int>(random.below(600)) - 300);
    const Eigen::Vector3d values =
        largest * Eigen::Vector3d(random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), 1.0);
    MatrixXd middle = with_eigenvalues(random, values);
    const UpwardRounding upward;
    const EnclosedMatrix matrix{middle, 1e-3 * largest};
    // The matrix that is meant may have a larger eigenvalue by the error.
    CHECK(largest_eigenvalue(matrix) >= largest * 1.000999);
    CHECK(largest_eigenvalue(matrix) <= largest * 1.0011);
    CHECK(norm_of_symmetric(matrix) >= largest * 1.000999);
    // |G^4|_F^(1/4) is at most 3^(1/8) of the largest.
    CHECK(norm_of_symmetric(matrix) <= largest * 1.0011 * std::pow(3.0, 0.125));
    CHECK(norm_of_symmetric({-middle, matrix.error}) == norm_of_symmetric(matrix));
  }
}

TEST_CASE("of matrices without a positive eigenvalue, or with entries that are unknown") {
  const UpwardRounding upward;
  const MatrixXd negative = -MatrixXd::Identity(2, 2);
  CHECK(largest_eigenvalue({negative, 0.0}) >= -1.0);
  CHECK(largest_eigenvalue({MatrixXd::Zero(2, 2), 0.25}) >= 0.25);
  CHECK(largest_eigenvalue({MatrixXd::Zero(2, 2), 0.25}) <= 0.2501);
  CHECK(norm_of_symmetric({MatrixXd::Zero(2, 2), 0.25}) >= 0.25);
  MatrixXd unknown = MatrixXd::Identity(2, 2);
  unknown(0, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(largest_eigenvalue({unknown, 0.0})));
  CHECK(std::isnan(norm_of_symmetric({unknown, 0.0})));
  CHECK(std::isnan(norm_of_symmetric({MatrixXd::Identity(2, 2), INFINITY})));
  // Of one that is not quite symmetric the lower triangle is taken, and the difference is counted.
  MatrixXd lopsided = MatrixXd::Identity(2, 2);
  lopsided(0, 1) = 0.5;
  CHECK(largest_eigenvalue({lopsided, 0.0}) >= 1.5);
}

}  // namespace
}  // namespace veritrack::model
