#include "analysis/theorems/invariant_covariance.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_polar_frame.hpp"

namespace veritrack::theorems {
namespace {

using rigor::Interval;
using rigor::Verdict;
using Tone = trackers::ToneModel<double>;

Eigen::Matrix3d middle_of(const rigor::IntervalMatrix<3>& m) {
  return rigor::midpoint(m);
}

Eigen::Matrix3d turned(const Eigen::Matrix3d& p, double angle) {
  Eigen::Matrix3d u = Eigen::Matrix3d::Identity();
  u(0, 0) = u(1, 1) = std::cos(angle);
  u(1, 0) = std::sin(angle);
  u(0, 1) = -u(1, 0);
  return u * p * u.transpose();
}

/// The Riccati step in the textbook's form, in the frame of the predicted phase.
Eigen::Matrix3d stepped(const Eigen::Matrix3d& p, double turn, double rho, const Tone& design) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(1, 2) = rho;
  f(2, 2) = 1.0 - design.epsilon;
  Eigen::Matrix3d predicted = f * turned(p, turn) * f.transpose();
  predicted.diagonal() += Eigen::Vector3d(design.q1, design.q1, design.q2);
  Eigen::Matrix2d innovation = predicted.topLeftCorner<2, 2>();
  innovation.diagonal().array() += design.r;
  const Eigen::Matrix<double, 3, 2> gain = predicted.leftCols<2>() * innovation.inverse();
  return predicted - gain * predicted.topRows<2>();
}

double least_eigenvalue(const Eigen::Matrix3d& m) {
  return oracle::least_eigenvalue(0.5 * (m + m.transpose()));
}

IntervalDesign enclosed(const Tone& d) {
  return {Interval(d.q1), Interval(d.q2), Interval(d.r), Interval(d.epsilon)};
}

TEST_CASE("every step of the tube leads from the range into it, from its upper and from its lower bound") {
  test::Random random(81);
  int found = 0;
  for (int k = 0; k < 60; ++k) {
    CAPTURE(k);
    const Tone design{random.uniform(5e-4, 5e-3), random.uniform(5e-4, 5e-3), random.uniform(0.01, 0.1),
                      k % 2 == 0 ? 0.0 : 0.01};
    const double plane = std::pow(10.0, random.uniform(-4.0, -0.7));
    const double frequency = std::pow(10.0, random.uniform(-4.0, -0.7));
    const rigor::UpwardRounding upward;
    const ErrorBounds tube{Interval(plane), Interval(frequency)};
    const auto range = invariant_range(enclosed(design), tube);
    if (!range) {
      continue;
    }
    ++found;
    const rigor::NearestRounding nearest;
    const Eigen::Matrix3d upper = middle_of(range->upper);
    const Eigen::Matrix3d lower = middle_of(range->information).inverse();
    CHECK(least_eigenvalue(lower) > 0.0);
    CHECK(least_eigenvalue(upper - lower) > 0.0);
    const double largest_turn = 2.0 * std::asin(plane) + frequency;
    for (int i = 0; i < 40; ++i) {
      const double turn =
          i < 2 ? (i == 0 ? -largest_turn : largest_turn) : random.uniform(-largest_turn, largest_turn);
      const double rho = i % 3 == 0   ? 1.0 - plane
                         : i % 3 == 1 ? 1.0 + plane
                                      : random.uniform(1.0 - plane, 1.0 + plane);
      CHECK(least_eigenvalue(upper - stepped(upper, turn, rho, design)) > -1e-13);
      CHECK(least_eigenvalue(stepped(lower, turn, rho, design) - lower) > -1e-13);
    }
  }
  CHECK(found > 10);
}

TEST_CASE(
    "matrices that bound no invariant range: too low above, too high below, and a lower one below zero") {
  const Tone design{0.0023, 0.0023, 0.05, 0.0};
  const rigor::UpwardRounding upward;
  const ErrorBounds tube{Interval(1e-4), Interval(1e-4)};
  const auto range = invariant_range(enclosed(design), tube);
  REQUIRE(range.has_value());
  const Eigen::Matrix3d high = middle_of(range->upper);
  Eigen::Matrix3d low = middle_of(range->information).inverse();
  low = 0.5 * (low + low.transpose()).eval();
  const auto is_verified = [&](const Eigen::Matrix3d& upper, const Eigen::Matrix3d& lower) {
    return verified_range(upper, lower, enclosed(design), tube).has_value();
  };
  CHECK(is_verified(1.01 * high, 0.99 * low));
  CHECK_FALSE(is_verified(0.9 * high, 0.99 * low));
  CHECK_FALSE(is_verified(1.01 * high, 1.1 * low));
  // A step leads from it to what is positive: it is a lower bound of nothing that the filter keeps.
  CHECK_FALSE(is_verified(1.01 * high, -1e-6 * Eigen::Matrix3d::Identity()));
}

TEST_CASE("a start is in the range only when it is between both bounds") {
  const Tone design{0.0023, 0.0023, 0.05, 0.0};
  const rigor::UpwardRounding upward;
  const ErrorBounds tube{Interval(1e-4), Interval(1e-4)};
  const auto range = invariant_range(enclosed(design), tube);
  REQUIRE(range.has_value());
  const Eigen::Matrix3d high = middle_of(range->upper);
  const Eigen::Matrix3d low = middle_of(range->information).inverse();
  const auto verdict = [&](const Eigen::Matrix3d& start) {
    const Eigen::Matrix3d even = 0.5 * (start + start.transpose());
    return decide_start(rigor::to_interval(rigor::Matrix<3>(even)), *range, enclosed(design), tube, 0);
  };
  CHECK(verdict(0.5 * (high + low)) == Verdict::proved);
  CHECK(verdict(1.01 * high) == Verdict::undecided);
  CHECK(verdict(0.99 * low) == Verdict::undecided);
  Eigen::Matrix3d known = 0.5 * (high + low);
  known(2, 2) = 0.5 * low(2, 2);
  known(1, 2) = known(2, 1) = 0.0;
  CHECK(verdict(known) == Verdict::undecided);
}

}  // namespace
}  // namespace veritrack::theorems
