#include "analysis/quadrature/contraction/riccati_order.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "analysis/rigor/small_definiteness.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "tests/trackers/random_tracker.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

Eigen::Matrix3d matrix(const BlockCovariance<double>& p) {
  Eigen::Matrix3d m;
  m << p.p11, 0.0, 0.0, 0.0, p.p22, p.p23, 0.0, p.p23, p.p33;
  return m;
}

/// Prediction and update as a textbook has them.
Eigen::Matrix3d textbook_update(const Eigen::Matrix3d& p, double rho,
                                const trackers::ToneModel<double>& design) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(1, 2) = rho;
  const Eigen::Matrix3d predicted =
      f * p * f.transpose() + Eigen::Matrix3d(Eigen::Vector3d(design.q1, design.q1, design.q2).asDiagonal());
  const Eigen::Matrix2d s = predicted.topLeftCorner<2, 2>() + design.r * Eigen::Matrix2d::Identity();
  return predicted - predicted.leftCols<2>() * s.inverse() * predicted.topRows<2>();
}

double smallest_eigenvalue(const Eigen::Matrix3d& m) {
  return oracle::least_eigenvalue(0.5 * (m + m.transpose()));
}

BlockCovariance<double> random_block(test::Random& random) {
  const Eigen::Matrix3d p = test::random_covariance(random);
  return {p(0, 0), p(1, 1), p(1, 2), p(2, 2)};
}

TEST_CASE("riccati_update is the textbook's prediction and update, with its gain") {
  test::Random random(71);
  for (int k = 0; k < 5000; ++k) {
    auto design = test::random_design(random);
    design.epsilon = 0.0;
    const auto p = random_block(random);
    const double rho = random.uniform(0.2, 2.0);
    const auto update = riccati_update(p, rho, design);
    const Eigen::Matrix3d expected = textbook_update(matrix(p), rho, design);
    const double scale = 1.0 + expected.norm();
    CHECK((matrix(update.filtered) - expected).norm() <= 1e-10 * scale);
    // K = Phi H' / r.
    CHECK(std::fabs(update.gain_amplitude * design.r - expected(0, 0)) <= 1e-10 * scale);
    CHECK(std::fabs(update.gain_phase * design.r - expected(1, 1)) <= 1e-10 * scale);
    CHECK(std::fabs(update.gain_frequency * design.r - expected(2, 1)) <= 1e-10 * scale);
  }
}

TEST_CASE("the update keeps the Loewner order") {
  test::Random random(72);
  for (int k = 0; k < 5000; ++k) {
    auto design = test::random_design(random);
    design.epsilon = 0.0;
    const Eigen::Matrix3d low = test::random_covariance(random);
    const Eigen::Matrix3d high = low + test::random_covariance(random);
    const double rho = random.uniform(0.2, 2.0);
    CHECK(smallest_eigenvalue(textbook_update(high, rho, design) - textbook_update(low, rho, design)) >=
          -1e-10);
  }
}

TEST_CASE("covariance bounds are called invariant only when no sampled turn leaves them") {
  test::Random random(73);
  const trackers::ToneModel<double> design{0.0013, 0.0013, 0.01, 0.0};
  BlockCovariance<double> steady{0.01, 0.01, 0.0, 0.01};
  for (int k = 0; k < 1000; ++k) {
    steady = riccati_update(steady, 1.0, design).filtered;
  }
  int proved = 0;
  int refuted = 0;
  for (int k = 0; k < 200; ++k) {
    const double down = random.uniform(0.2, 1.0);
    const double up = random.uniform(1.0, 6.0);
    const auto scaled = [&](double f) {
      return BlockCovariance<double>{f * steady.p11, f * steady.p22, f * steady.p23, f * steady.p33};
    };
    const auto exact = [](const BlockCovariance<double>& p) {
      return BlockCovariance<Interval>{Interval(p.p11), Interval(p.p22), Interval(p.p23), Interval(p.p33)};
    };
    const double radius = random.uniform(0.0, 0.2);
    const double tangent = random.uniform(0.0, 0.3);
    const double room = random.below(2) == 0 ? 0.0 : random.uniform(0.0, 0.2);
    double worst = 1.0;
    for (int i = 0; i <= 10; ++i) {
      for (int j = 0; j <= 10; ++j) {
        const double rho = 1.0 - radius + 0.2 * radius * i;
        const double angle = std::atan(tangent * (0.2 * j - 1.0));
        Eigen::Matrix3d u = Eigen::Matrix3d::Identity();
        u.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(angle).toRotationMatrix();
        const Eigen::Matrix3d low = u * textbook_update(matrix(scaled(down)), rho, design) * u.transpose();
        const Eigen::Matrix3d high = u * textbook_update(matrix(scaled(up)), rho, design) * u.transpose();
        worst = std::min({worst, smallest_eigenvalue(low - matrix(scaled((1.0 + room) * down))),
                          smallest_eigenvalue(matrix(scaled((1.0 - room) * up)) - high)});
      }
    }
    const rigor::UpwardRounding upward;
    const bool kept = certainly_keeps_covariance_between(
        exact(scaled(down)), exact(scaled(up)),
        {Interval(design.q1), Interval(design.q2), Interval(design.r), Interval(0.0)},
        {{Interval::from_bounds(1.0 - radius, 1.0 + radius), tangent}}, room);
    if (worst < -1e-12) {
      ++refuted;
      CHECK_FALSE(kept);
    }
    proved += kept ? 1 : 0;
  }
  CHECK(proved > 10);
  CHECK(refuted > 10);
}

TEST_CASE("definiteness by pivots agrees with eigenvalues and refuses what is not finite") {
  test::Random random(74);
  int definite = 0;
  for (int k = 0; k < 2000; ++k) {
    Eigen::Matrix4d a;
    for (int i = 0; i < 16; ++i) {
      a(i / 4, i % 4) = random.uniform(-1.0, 1.0);
    }
    const Eigen::Matrix4d m = a * a.transpose() - random.uniform(0.0, 0.3) * Eigen::Matrix4d::Identity();
    const double least = oracle::least_eigenvalue(m);
    rigor::LowerTriangle<4> lower;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        lower[i][j] = Interval(m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
      }
    }
    const rigor::UpwardRounding upward;
    const bool positive = rigor::certainly_positive_definite<4>(lower);
    definite += positive ? 1 : 0;
    if (std::fabs(least) > 1e-9) {
      CHECK(positive == (least > 0.0));
    }
    lower[2][1] = k % 2 == 0 ? Interval::empty() : Interval::entire();
    CHECK_FALSE(rigor::certainly_positive_definite<4>(lower));
  }
  CHECK(definite > 100);
}

}  // namespace
}  // namespace veritrack::quadrature
