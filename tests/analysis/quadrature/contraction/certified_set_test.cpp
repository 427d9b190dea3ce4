#include "analysis/quadrature/contraction/certified_set.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

CertifiedSet example() {
  CertifiedSet set;
  set.metric << 2.0, 0.0, 0.0, 0.0, 1.5, -0.7, 0.0, 0.0, 4.0;
  set.radius = 0.5;
  set.covariance_lower = Eigen::Vector3d(0.1, 0.1, 0.2).asDiagonal();
  set.covariance_upper = Eigen::Vector3d(1.0, 2.0, 3.0).asDiagonal();
  set.covariance_upper(1, 2) = set.covariance_upper(2, 1) = 0.5;
  return set;
}

TEST_CASE("bounds on the errors are attained on the rim of the ellipsoid and never exceeded in it") {
  const CertifiedSet set = example();
  const Eigen::Matrix3d inverse = set.metric.inverse();
  rigor::IntervalVector<3> bounds;
  {
    const rigor::UpwardRounding upward;
    bounds = error_bounds(set, Interval(set.radius));
  }
  test::Random random(41);
  for (int i = 0; i < 3; ++i) {
    const double reached = set.radius * inverse.row(i).norm();
    CHECK(bounds[i].lower() <= reached + 1e-15);
    CHECK(bounds[i].upper() >= reached - 1e-15);
    CHECK(bounds[i].upper() <= reached * (1.0 + 1e-14));
  }
  for (int k = 0; k < 1000; ++k) {
    Eigen::Vector3d u(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Eigen::Vector3d e = inverse * u.normalized() * (0.999 * set.radius);
    for (int i = 0; i < 3; ++i) {
      CHECK(std::fabs(e(i)) <= bounds[i].upper());
    }
  }
}

TEST_CASE("membership is proved inside and never outside") {
  const CertifiedSet set = example();
  const Eigen::Matrix3d inverse = set.metric.inverse();
  test::Random random(42);
  const Eigen::Matrix3d middle = 0.5 * (set.covariance_lower + set.covariance_upper);
  for (int k = 0; k < 1000; ++k) {
    Eigen::Vector3d u(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const double level = random.uniform(0.5, 1.5);
    const Eigen::Vector3d e = inverse * u.normalized() * (level * set.radius);
    Eigen::Matrix3d p = middle;
    const double shift = random.uniform(-0.3, 0.3);
    p(0, 2) += shift;
    p(2, 0) += shift;
    p(0, 0) += random.uniform(-1.0, 1.0);
    const double margin = std::min(oracle::least_eigenvalue(p - set.covariance_lower),
                                   oracle::least_eigenvalue(set.covariance_upper - p));
    const rigor::UpwardRounding upward;
    const bool inside = certainly_contains(set, rigor::to_interval(e), rigor::to_interval(p));
    if (level > 1.0 + 1e-9 || margin < -1e-9) {
      CHECK_FALSE(inside);
    }
    if (level < 1.0 - 1e-9 && margin > 1e-9) {
      CHECK(inside);
    }
  }
}

TEST_CASE("what is not finite is not contained") {
  const CertifiedSet set = example();
  const rigor::UpwardRounding upward;
  const rigor::IntervalVector<3> zero = rigor::IntervalVector<3>::Constant(Interval(0.0));
  const Eigen::Matrix3d middle = 0.5 * (set.covariance_lower + set.covariance_upper);
  const rigor::IntervalMatrix<3> covariance = rigor::to_interval(middle);
  CHECK(certainly_contains(set, zero, covariance));
  for (const Interval& bad : {Interval::empty(), Interval::entire()}) {
    for (int i = 0; i < 3; ++i) {
      rigor::IntervalVector<3> error = zero;
      error[i] = bad;
      CHECK_FALSE(certainly_contains(set, error, covariance));
      rigor::IntervalMatrix<3> p = covariance;
      p(i, 2) = bad;
      CHECK_FALSE(certainly_contains(set, zero, p));
    }
  }
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 0.0}) {
    CertifiedSet broken = set;
    broken.metric(1, 1) = bad;
    CHECK_FALSE(is_finite(error_bounds(broken, Interval(1.0))[1]));
    if (bad != 0.0) {
      CHECK_FALSE(certainly_contains(broken, zero, covariance));
    }
  }
}

}  // namespace
}  // namespace veritrack::quadrature
