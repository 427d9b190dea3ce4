#include "analysis/rigor/symmetric_eigensystem.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/support/random.hpp"

namespace veritrack::rigor {
namespace {

Eigen::MatrixXd random_matrix(test::Random& random, int n) {
  return Eigen::MatrixXd::NullaryExpr(n, n, [&] { return random.uniform(-1.0, 1.0); });
}

TEST_CASE("eigensystems satisfy their equations") {
  test::Random random(3601);
  for (int n = 1; n <= kMostSmallRows; ++n) {
    const Eigen::MatrixXd any = random_matrix(random, n);
    const Eigen::MatrixXd a = any + any.transpose();
    const Eigensystem system = symmetric_eigensystem(a);
    CHECK((symmetric_eigenvectors(a) - system.vectors).norm() < 1e-9 * n);
    CHECK((a * system.vectors - system.vectors * system.values.asDiagonal()).norm() < 1e-12 * n);
    CHECK(largest_eigenvalue(a) == doctest::Approx(system.values[n - 1]).epsilon(1e-12));
    CHECK(least_eigenvalue(a) == doctest::Approx(system.values[0]).epsilon(1e-12));
    CHECK(largest_absolute_eigenvalue(a) ==
          doctest::Approx(std::max(-system.values[0], system.values[n - 1])).epsilon(1e-12));
    const Eigen::MatrixXd b = any * any.transpose() + Eigen::MatrixXd::Identity(n, n);
    const Eigensystem pencil = pencil_eigensystem(a, b);
    CHECK((pencil_eigenvectors(a, b) - pencil.vectors).norm() < 1e-9 * n);
    CHECK((a * pencil.vectors - b * pencil.vectors * pencil.values.asDiagonal()).norm() < 1e-11 * n);
    CHECK((pencil.vectors.transpose() * b * pencil.vectors - Eigen::MatrixXd::Identity(n, n)).norm() <
          1e-11 * n);
  }
}

TEST_CASE("an eigensystem of what is too large is refused") {
  CHECK_THROWS_AS(static_cast<void>(symmetric_eigensystem(Eigen::MatrixXd::Identity(21, 21))),
                  std::length_error);
  const Eigen::MatrixXd large = 3.0 * Eigen::MatrixXd::Identity(21, 21);
  CHECK(largest_eigenvalue(large) == doctest::Approx(3.0));
}

}  // namespace
}  // namespace veritrack::rigor
