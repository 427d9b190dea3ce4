#include "analysis/rigor/symmetric_three.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "analysis/rigor/symmetric_eigensystem.hpp"
#include "tests/support/random.hpp"

namespace veritrack::rigor {
namespace {

Matrix<3> random_three(test::Random& random) {
  return Matrix<3>::NullaryExpr([&] { return random.uniform(-1.0, 1.0); });
}

}  // namespace

TEST_CASE("eigensystems of three rows satisfy their equations, and are those of any size") {
  test::Random random(3611);
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix<3> any = random_three(random);
    const Matrix<3> a = any + any.transpose();
    const ThreeEigensystem system = eigensystem_of_three(a);
    CHECK((a * system.vectors - system.vectors * system.values.asDiagonal()).norm() < 1e-6);
    CHECK((system.values - symmetric_eigensystem(a).values).norm() < 1e-6);
    const Matrix<3> b = random_three(random);
    const Matrix<3> positive = b * b.transpose() + 0.1 * Matrix<3>::Identity();
    const ThreeEigensystem pencil = pencil_of_three(a, positive);
    CHECK((a * pencil.vectors - positive * pencil.vectors * pencil.values.asDiagonal()).norm() < 1e-10);
    CHECK((pencil.vectors.transpose() * positive * pencil.vectors - Matrix<3>::Identity()).norm() < 1e-10);
    CHECK(pencil.values[0] <= pencil.values[1]);
    CHECK(pencil.values[1] <= pencil.values[2]);
    const auto root = cholesky_of_three(positive);
    REQUIRE(root);
    CHECK((*root * root->transpose() - positive).norm() < 1e-12);
    CHECK((*root)(0, 2) == 0.0);
    CHECK(std::fabs(least_eigenvalue_in_units(*root, a) - pencil.values[0]) < 1e-5);
  }
}

TEST_CASE("what is not positive definite, or not a number, has no root") {
  CHECK_FALSE(cholesky_of_three(-Matrix<3>::Identity()));
  Matrix<3> unknown = Matrix<3>::Identity();
  unknown(2, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(cholesky_of_three(unknown));
}

}  // namespace veritrack::rigor
