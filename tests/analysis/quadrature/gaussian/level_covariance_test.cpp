#include "analysis/quadrature/gaussian/level_covariance.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

Eigen::Matrix3d matrix_of(const LevelCovariance<double>& p) {
  Eigen::Matrix3d m;
  m << p.p11, p.p12, p.p13, p.p12, p.p22, p.p23, p.p13, p.p23, p.p33;
  return m;
}

LevelCovariance<double> some_covariance(bool apart, test::Random& random) {
  LevelCovariance<double> p{random.uniform(1.0, 2.0), random.uniform(1.0, 2.0), random.uniform(-0.4, 0.4),
                            random.uniform(1.0, 2.0)};
  if (!apart) {
    p.p12 = random.uniform(-0.4, 0.4);
    p.p13 = random.uniform(-0.4, 0.4);
    p.apart = false;
  }
  return p;
}

}  // namespace

TEST_CASE("inverse, sum and slope are those of the whole matrices, with the entries 12 and 13 and without") {
  test::Random random(4320);
  for (int k = 0; k < 200; ++k) {
    const LevelCovariance<double> p = some_covariance(k % 2 == 0, random);
    const LevelCovariance<double> d = some_covariance(k % 3 == 0, random);
    const Eigen::Matrix3d x = matrix_of(p);
    const double s = random.uniform(0.0, 2.0);
    CHECK((matrix_of(inverse(p)) - x.inverse()).norm() < 1e-13);
    CHECK((matrix_of(moved(p, s, d)) - (x + s * matrix_of(d))).norm() < 1e-14);
    CHECK((matrix_of(lower_slope(p, d)) + x * matrix_of(d) * x).norm() < 1e-13);
  }
}

TEST_CASE("whether a matrix is apart is read off its numbers") {
  CHECK(level_covariance<double>({1.0, 1.0, 0.0, 1.0, 0.0, 0.0, false}).apart);
  CHECK_FALSE(level_covariance<double>({1.0, 1.0, 0.0, 1.0, 0.0, 1e-300, true}).apart);
  CHECK_FALSE(level_covariance<double>({1.0, 1.0, 0.0, 1.0, 1e-300, 0.0, true}).apart);
}

}  // namespace veritrack::quadrature
