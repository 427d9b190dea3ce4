#include "analysis/quadrature/gaussian/noise_determinant.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/quadrature/gaussian/lock_sets.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using Matrix = Eigen::Matrix3d;

SymmetricMatrix<Interval> enclosed(const Matrix& m) {
  SymmetricMatrix<Interval> result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      result[i][j] = Interval(m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
  return result;
}

Matrix random_symmetric(test::Random& random) {
  Matrix m;
  for (Eigen::Index i = 0; i < 9; ++i) {
    m(i / 3, i % 3) = random.uniform(-1.0, 1.0);
  }
  return m + m.transpose();
}

}  // namespace

TEST_CASE("the bound is above the determinant of every covariance between two, and not far above") {
  test::Random random(4320);
  double closest = 10.0;
  for (int k = 0; k < 300; ++k) {
    LockSet set = test_sets::lock_set(0, random.uniform(15.0, 25.0));
    const double walk = k % 2 == 0 ? 0.0 : 0.005;
    const double r = 0.01;
    const BlockMetric<double>& metric = set.metric;
    LockSetting<Interval> setting;
    setting.design = {Interval(0.0005), Interval(0.0005), Interval(r), Interval(0.0)};
    setting.metric = {Interval(metric.amplitude), Interval(metric.phase), Interval(metric.coupling),
                      Interval(metric.frequency)};
    setting.noise_variance = Interval(set.noise_deviation * set.noise_deviation);
    setting.walk_variance = Interval(walk * walk);
    Matrix mean =
        Matrix(0.001 * Eigen::Vector3d(3.0, 5.0, 1.6).asDiagonal()) + 1e-4 * random_symmetric(random);
    const Matrix root = 0.02 * random_symmetric(random);
    const Matrix half_spread = root * root.transpose();
    double bound = 0.0;
    {
      const rigor::UpwardRounding upward;
      LevelImages<Interval> images;
      images.mean = enclosed(mean);
      images.half_spread = enclosed(half_spread);
      bound = NoiseDeterminant(setting).bound(images).upper();
    }
    Matrix t;
    t << metric.amplitude, 0.0, 0.0, 0.0, metric.phase, metric.coupling, 0.0, 0.0, metric.frequency;
    for (int l = 0; l < 20; ++l) {
      // Any symmetric matrix with eigenvalues of 1 in size.
      const Eigen::SelfAdjointEigenSolver<Matrix> solver(random_symmetric(random));
      const Eigen::Vector3d signs(l % 2 == 0 ? 1.0 : -1.0, l % 4 < 2 ? 1.0 : -1.0, l % 8 < 4 ? 1.0 : -1.0);
      const Matrix y = solver.eigenvectors() * signs.asDiagonal() * solver.eigenvectors().transpose();
      const Matrix p = mean + root * y * root.transpose();
      const Eigen::Matrix<double, 3, 2> gain = p.leftCols<2>() / r;
      const Eigen::Vector3d e3(0.0, 0.0, 1.0);
      const Matrix sigma = set.noise_deviation * set.noise_deviation * gain * gain.transpose() +
                           walk * walk * e3 * e3.transpose();
      const double determinant = (Matrix::Identity() - sigma * t.transpose() * t).determinant();
      if (!std::isfinite(bound)) {
        continue;  // nothing is said
      }
      CHECK(determinant > 0.0);
      CHECK(-std::log(determinant) <= bound);
      closest = std::min(closest, bound + std::log(determinant));
    }
  }
  MESSAGE("closest " << closest);
  CHECK(closest < 0.1);
}

}  // namespace veritrack::quadrature
