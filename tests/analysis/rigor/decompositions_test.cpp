#include "analysis/rigor/decompositions.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
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

TEST_CASE("the spectral radius and its mode, of a rotation and of a triangle") {
  Eigen::Matrix3d rotation;
  rotation << 0.6, -0.8, 0.0, 0.8, 0.6, 0.0, 0.0, 0.0, 0.5;
  CHECK(spectral_radius(rotation) == doctest::Approx(1.0));
  CHECK(largest_argument(rotation) == doctest::Approx(std::atan2(0.8, 0.6)));
  const DominantMode turned = dominant_mode(rotation);
  CHECK(turned.radius == doctest::Approx(1.0));
  CHECK(turned.vector[0] == doctest::Approx(turned.vector[1]));
  CHECK(turned.vector[2] == doctest::Approx(0.0));
  Eigen::Matrix2d triangle;
  triangle << 0.9, 3.0, 0.0, 0.1;
  const DominantMode mode = dominant_mode(triangle);
  CHECK(mode.radius == doctest::Approx(0.9));
  CHECK(mode.vector[1] == doctest::Approx(0.0));
}

TEST_CASE("what is too large, or not square, is refused") {
  CHECK_THROWS_AS(static_cast<void>(symmetric_eigensystem(Eigen::MatrixXd::Identity(21, 21))),
                  std::length_error);
  const Eigen::MatrixXd large = 3.0 * Eigen::MatrixXd::Identity(21, 21);
  CHECK(largest_eigenvalue(large) == doctest::Approx(3.0));
  CHECK_THROWS_AS(static_cast<void>(spectral_radius(Eigen::MatrixXd::Zero(2, 3))), std::length_error);
}

}  // namespace
}  // namespace veritrack::rigor
