#include "analysis/theorems/homogeneous_trajectory.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "tests/support/random.hpp"

namespace {

using namespace veritrack;
using rigor::Interval;
using Vector = Eigen::Matrix<long double, 3, 1>;
using Square = Eigen::Matrix<long double, 3, 3>;

struct Textbook {
  Vector z;
  Square covariance;
  long double relative_decrease = 0.0L;
};

Square transition_jacobian(const Vector& x, long double epsilon) {
  const long double c = std::cos(x(2)), s = std::sin(x(2));
  Square f;
  f << c, -s, -x(0) * s - x(1) * c, s, c, x(0) * c - x(1) * s, 0.0L, 0.0L, 1.0L - epsilon;
  return f;
}

/// Theorem 2.8's equations (2.34) as they stand, in full matrices.
Textbook textbook_step(const Vector& x, const Vector& z, const Square& p, double q1, double q2, double r,
                       double epsilon) {
  const Square f_bar = transition_jacobian(x - z, static_cast<long double>(epsilon));
  Square q = Square::Zero();
  q.diagonal() << q1, q1, q2;
  const Square predicted = f_bar * p * f_bar.transpose() + q;
  Eigen::Matrix<long double, 2, 3> h = Eigen::Matrix<long double, 2, 3>::Zero();
  h(0, 0) = h(1, 1) = 1.0L;
  const Eigen::Matrix<long double, 2, 2> s =
      h * predicted * h.transpose() +
      static_cast<long double>(r) * Eigen::Matrix<long double, 2, 2>::Identity();
  const Eigen::Matrix<long double, 3, 2> gain = predicted * h.transpose() * s.inverse();
  Textbook result;
  result.covariance = (Square::Identity() - gain * h) * predicted;
  result.z = (Square::Identity() - gain * h) * transition_jacobian(x, static_cast<long double>(epsilon)) * z;
  const long double before = z.dot(p.inverse() * z);
  const long double after = result.z.dot(result.covariance.inverse() * result.z);
  result.relative_decrease = (before - after) / z.squaredNorm();
  return result;
}

}  // namespace

TEST_CASE("a step of (2.34) is the textbook's, also where z is large enough to move the gain") {
  test::Random random(2930);
  const std::int64_t count = test::effort(2000);
  for (std::int64_t i = 0; i < count; ++i) {
    const Eigen::Vector3d x(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-3.0, 3.0));
    const Eigen::Vector3d z(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const Eigen::Matrix3d root = Eigen::Matrix3d::NullaryExpr([&] { return random.uniform(-0.3, 0.3); });
    const Eigen::Matrix3d p = root * root.transpose() + 0.1 * Eigen::Matrix3d::Identity();
    const double q1 = random.uniform(0.001, 0.1), q2 = random.uniform(0.001, 0.1),
                 r = random.uniform(0.01, 1.0);
    const double epsilon = random.uniform(0.0, 0.3);
    const double length = std::pow(2.0, random.uniform(-20.0, 1.0));
    const auto state = theorems::start_homogeneous(z, length, p);
    theorems::HomogeneousStep step;
    Interval size;
    {
      const rigor::UpwardRounding upward;
      step =
          theorems::step_homogeneous(state, x, {Interval(q1), Interval(q2), Interval(r), Interval(epsilon)});
      size = theorems::magnitude_of(state);
    }
    CHECK(std::fabs(size.upper() - length) <= 1e-14 * length);
    const Vector z_big = state.direction.cast<long double>() * std::ldexp(1.0L, state.exponent);
    const Textbook oracle = textbook_step(x.cast<long double>(), z_big,
                                          state.covariance.matrix().cast<long double>(), q1, q2, r, epsilon);
    const Vector next = step.next.direction.cast<long double>() * std::ldexp(1.0L, step.next.exponent);
    CHECK(static_cast<double>((next - oracle.z).norm()) <= 1e-12 * static_cast<double>(z_big.norm()));
    CHECK(static_cast<double>(
              (step.next.covariance.matrix().cast<long double>() - oracle.covariance).norm()) <= 1e-12);
    REQUIRE(is_finite(step.relative_decrease));
    const double scale = 1.0 / static_cast<double>(p.cast<long double>().inverse().norm());
    const double truth = static_cast<double>(oracle.relative_decrease);
    CHECK(scale * std::fabs(step.relative_decrease.lower() - truth) <= 1e-10);
    CHECK(scale * std::fabs(step.relative_decrease.upper() - truth) <= 1e-10);
    CHECK(step.relative_decrease.upper() - step.relative_decrease.lower() <= 1e-10 / scale);
  }
}

TEST_CASE("z shrinks below the smallest double without losing its direction or its decrease") {
  const trackers::ToneModel<Interval> design{Interval(0.01), Interval(0.01), Interval(0.01), Interval(0.0)};
  auto state =
      theorems::start_homogeneous(Eigen::Vector3d(1.0, 2.0, 0.5), 1e-10, Eigen::Matrix3d::Identity() * 0.05);
  const rigor::UpwardRounding upward;
  for (int k = 0; k < 3000; ++k) {
    const auto step = theorems::step_homogeneous(state, Eigen::Vector3d(1.0, 0.0, 0.3), design);
    REQUIRE(is_finite(step.relative_decrease));
    REQUIRE(certainly_positive(step.relative_decrease));
    REQUIRE(step.next.direction.cwiseAbs().maxCoeff() >= 0.5);
    state = step.next;
  }
  CHECK(state.exponent < -1100);
  const Interval size = theorems::magnitude_of(state);
  CHECK(size.lower() == 0.0);
  CHECK(size.upper() <= 1e-300);
}

TEST_CASE("NaN in, nothing out") {
  const trackers::ToneModel<Interval> design{Interval(0.01), Interval(0.01), Interval(0.01), Interval(0.0)};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const rigor::UpwardRounding upward;
  const auto good =
      theorems::start_homogeneous(Eigen::Vector3d(1.0, 0.0, 0.0), 1e-3, Eigen::Matrix3d::Identity());
  CHECK(is_empty(theorems::step_homogeneous(good, Eigen::Vector3d(nan, 0.0, 0.3), design).relative_decrease));
  const auto bad =
      theorems::start_homogeneous(Eigen::Vector3d(1.0, 0.0, 0.0), 1e-3, Eigen::Matrix3d::Constant(nan));
  CHECK(is_empty(theorems::step_homogeneous(bad, Eigen::Vector3d(1.0, 0.0, 0.3), design).relative_decrease));
  const auto indefinite =
      theorems::start_homogeneous(Eigen::Vector3d(1.0, 0.0, 0.0), 1e-3, -Eigen::Matrix3d::Identity());
  CHECK(is_empty(
      theorems::step_homogeneous(indefinite, Eigen::Vector3d(1.0, 0.0, 0.3), design).relative_decrease));
}

TEST_CASE("a covariance that is not positive definite has no energy, in whichever factor") {
  const trackers::ToneModel<Interval> design{Interval(0.01), Interval(0.01), Interval(0.01), Interval(0.0)};
  const rigor::UpwardRounding upward;
  const auto decrease = [&](const trackers::FactoredCovariance<double>& covariance) {
    const theorems::HomogeneousState state{Eigen::Vector3d(1.0, 0.0, 0.0), -10, covariance};
    return theorems::step_homogeneous(state, Eigen::Vector3d(1.0, 0.0, 0.3), design).relative_decrease;
  };
  CHECK(is_finite(decrease({0.001, 0.0, 0.001, 0.0, 0.0, 0.001})));
  CHECK(is_empty(decrease({-0.001, 0.0, -0.001, 0.0, 0.0, 0.001})));
  CHECK(is_empty(decrease({0.001, 0.002, 0.001, 0.0, 0.0, 0.001})));
  CHECK(is_empty(decrease({0.001, 0.0, 0.001, 0.0, 0.0, -0.001})));
}
