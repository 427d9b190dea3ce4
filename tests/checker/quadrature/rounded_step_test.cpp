// The checker's bound on rounding against the tracker that runs, beside its twin in long double.
#include "checker/quadrature/rounded_step.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "tests/support/oracles.hpp"
#include "tests/trackers/random_tracker.hpp"

namespace {

using namespace veritrack;
using checker::Ball;
using Wide = long double;

trackers::QuadratureEstimate<Wide> widened(const trackers::QuadratureEstimate<double>& e) {
  const auto& p = e.covariance;
  return {e.in_phase,
          e.quadrature,
          e.frequency,
          {p.conditional_11, p.conditional_12, p.conditional_22, p.regression_1, p.regression_2,
           p.frequency_variance}};
}

Eigen::Matrix3d turn(double angle) {
  Eigen::Matrix3d u = Eigen::Matrix3d::Identity();
  u.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return u;
}

checker::Matrix3 balls(const Eigen::Matrix3d& p) {
  checker::Matrix3 result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      result[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = Ball(p(i, j));
    }
  }
  return result;
}

/// The largest share of its bound that any part of the state after a step reaches.
double share(const trackers::ToneModel<double>& design, const trackers::QuadratureEstimate<double>& start,
             const Eigen::Vector2d& y, const checker::Rounding& bound) {
  const trackers::ToneModel<Wide> same{design.q1, design.q2, design.r, design.epsilon};
  const auto computed = widened(trackers::step(start, y[0], y[1], design).filtered);
  const auto exact = trackers::step(widened(start), Wide{y[0]}, Wide{y[1]}, same).filtered;
  const Eigen::Matrix<Wide, 3, 3> p = computed.covariance.matrix() - exact.covariance.matrix();
  const Eigen::Matrix2d zz = p.topLeftCorner<2, 2>().cast<double>();
  return std::max(
      {static_cast<double>(
           std::hypot(computed.in_phase - exact.in_phase, computed.quadrature - exact.quadrature)) /
           bound.z.near(),
       static_cast<double>(std::fabs(computed.frequency - exact.frequency)) / bound.frequency.near(),
       oracle::symmetric_eigenvalues(zz).cwiseAbs().maxCoeff() / bound.p_zz.near(),
       static_cast<double>(std::hypot(p(0, 2), p(1, 2))) / bound.p_z3.near(),
       static_cast<double>(std::fabs(p(2, 2))) / bound.p_33.near()});
}

}  // namespace

TEST_CASE("no step in double is further from its long double twin than the checker's bound") {
  test::Random random(7120);
  double largest = 0.0;
  std::int64_t unbounded = 0;
  const std::int64_t trials = test::effort(300);
  for (std::int64_t i = 0; i < trials; ++i) {
    const trackers::ToneModel<double> design = test::random_design(random);
    const Eigen::Matrix3d low = test::random_covariance(random);
    const double spread = random.below(2) == 0 ? 1e-6 : 1.0;
    checker::Held held;
    held.z = Ball(1.3);
    held.frequency = Ball(3.5);
    held.measurement = Ball(1.1);
    checker::add_covariance(balls(low), balls((1.0 + spread) * low), held);
    const checker::Rounding bound = checker::rounded_step(
        {Ball(design.q1), Ball(design.q2), Ball(design.r), Ball(design.epsilon), Ball(1.0)}, held);
    if (!bound.finite()) {
      ++unbounded;  // its sizes are crude where variances differ by many decades
      continue;
    }
    for (int k = 0; k < 10; ++k) {
      const double angle = random.uniform(0.0, 2.0 * M_PI);
      const double length = random.uniform(0.1, 1.29);
      const double direction = random.uniform(0.0, 2.0 * M_PI);
      const Eigen::Matrix3d p =
          turn(direction) * ((1.0 + spread * random.uniform(0.01, 0.99)) * low) * turn(-direction);
      const trackers::QuadratureEstimate<double> start{length * std::cos(angle), length * std::sin(angle),
                                                       random.uniform(-3.5, 3.5),
                                                       trackers::FactoredCovariance<double>::from_matrix(p)};
      const double phase = random.uniform(0.0, 2.0 * M_PI);
      largest = std::max(
          largest, share(design, start, 1.09 * Eigen::Vector2d(std::cos(phase), std::sin(phase)), bound));
    }
  }
  MESSAGE("the largest share of the checker's bound: " << largest << "; none in " << unbounded << " of "
                                                       << trials);
  CHECK(unbounded <= trials / 10);
  CHECK(largest <= 1.0);
  CHECK(largest >= 0.05);
}

TEST_CASE("a share of P covers every small matrix within the bounds, and is not much more than needed") {
  const checker::Matrix3 p = checker::diagonal(Ball(1.0), Ball(1.0), Ball(4.0));
  const checker::PolarRounding rounding{Ball(0.0),   Ball(0.0),   Ball(0.0),
                                        Ball(1e-14), Ball(2e-14), Ball(4e-14)};
  const Ball share = checker::rounding_share(p, rounding);
  REQUIRE(share.finite());
  // [[1e-14, 2e-14], [2e-14, 4e-14]] needs 2e-14.
  CHECK(share.near() >= 2e-14);
  CHECK(share.near() <= 4e-14);
  CHECK_FALSE(checker::rounding_share(checker::diagonal(Ball(1.0), Ball(1.0), Ball(0.0)), rounding).finite());
}

TEST_CASE("what cannot be bounded is not") {
  checker::Held held;
  held.z = held.measurement = held.frequency = Ball(1.0);
  const checker::Matrix3 p = checker::diagonal(Ball(1.0), Ball(1.0), Ball(1.0));
  checker::add_covariance(p, p, held);
  const checker::Filter filter{Ball(0.01), Ball(0.01), Ball(0.1), Ball(0.0), Ball(1.0)};
  CHECK(checker::rounded_step(filter, held).finite());
  for (const double amplitude : {0.0, 0x1p-61, 0x1p61}) {
    checker::Filter other = filter;
    other.amplitude = Ball(amplitude);
    CHECK_FALSE(checker::rounded_step(other, held).finite());
  }
  checker::Filter noiseless = filter;
  noiseless.r = Ball(0.0);
  CHECK_FALSE(checker::rounded_step(noiseless, held).finite());
  checker::Held unknown = held;
  checker::add_covariance(checker::diagonal(Ball(1.0), Ball(1.0), Ball(0.0)), p, unknown);
  CHECK_FALSE(checker::rounded_step(filter, unknown).finite());
  checker::add_covariance(checker::diagonal(Ball(1.0), Ball(1.0), Ball(-0.5)), p, unknown);
  CHECK_FALSE(unknown.u.finite());
  unknown = held;
  unknown.least_d = Ball(-1e-9);
  CHECK_FALSE(checker::rounded_step(filter, unknown).finite());
  unknown = held;
  unknown.z = Ball::everything();
  CHECK_FALSE(checker::rounded_step(filter, unknown).finite());
}

TEST_CASE("designs of no filter, sizes beyond what underflow allows and vanishing divisors have no bound") {
  checker::Held held;
  held.z = held.measurement = held.frequency = Ball(1.0);
  const checker::Matrix3 p = checker::diagonal(Ball(1.0), Ball(1.0), Ball(1.0));
  checker::add_covariance(p, p, held);
  checker::Filter filter{Ball(0.01), Ball(0.01), Ball(0.1), Ball(0.01), Ball(1.0)};
  CHECK(checker::rounded_step(filter, held).finite());
  SUBCASE("q1") {
    filter.q1 = Ball(-0.001);
  }
  SUBCASE("q2") {
    filter.q2 = Ball(-0.001);
  }
  SUBCASE("a leak below 0") {
    filter.epsilon = Ball(-0.01);
  }
  SUBCASE("a leak of 1") {
    filter.epsilon = Ball(1.0);
  }
  SUBCASE("a frequency of 2^600 rad/sample") {
    held.frequency = Ball(0x1p600);
  }
  SUBCASE("a variance of which only the error is known") {
    held.least_d = Ball(1e-25);
    filter.q2 = Ball(1e-25);
  }
  CHECK_FALSE(checker::rounded_step(filter, held).finite());
}
