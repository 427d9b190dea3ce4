#include "analysis/model/shape/shape_bounds.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/analysis/model/shape/shape_examples.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_entries(test::Random& random, Index rows, Index columns, double size) {
  return MatrixXd::NullaryExpr(rows, columns, [&] { return random.uniform(-size, size); });
}

/// Random derivatives up to the third order at three phases, two states and two channels.
CurveDynamics random_dynamics(test::Random& random) {
  CurveDynamics dynamics = test::constant_dynamics(0.5 * MatrixXd::Identity(2, 2), MatrixXd::Ones(2, 2),
                                                   {2, MatrixXd::Zero(4, 4)}, 1);
  for (StepDerivatives& step : dynamics.step) {
    step.state = random_entries(random, 2, 2, 0.5);
    step.sample = random_entries(random, 2, 2, 0.3);
    for (MatrixXd& hessian : step.second) {
      const MatrixXd half = random_entries(random, 4, 4, 0.5);
      hessian = half + half.transpose();
    }
    for (Index row = 0; row < 2; ++row) {
      // Symmetric in its indices: one number for each count of the second state.
      for (int place = 0; place < 8; ++place) {
        const int seconds = (place & 1) + (place >> 1 & 1) + (place >> 2);
        step.third(row, place) = 0.25 * static_cast<double>(1 + row) * (seconds - 1.25);
      }
    }
  }
  for (Eigen::RowVectorXd& gradient : dynamics.gradient) {
    gradient = random_entries(random, 1, 2, 1.0);
  }
  for (MatrixXd& hessian : dynamics.hessian) {
    const MatrixXd half = random_entries(random, 2, 2, 0.5);
    hessian = half + half.transpose();
  }
  dynamics.slew = random_entries(random, 2, 3, 0.3);
  return dynamics;
}

ShapeOnGrid random_shape(test::Random& random) {
  ShapeOnGrid shape{MatrixXd::Zero(4, 3), MatrixXd::Zero(4, 3)};
  for (MatrixXd* part : {&shape.here, &shape.next}) {
    for (Index j = 0; j < 3; ++j) {
      part->col(j) << random.uniform(0.8, 1.2), random.uniform(-0.3, 0.3), 0.0, random.uniform(0.8, 1.2);
    }
  }
  return shape;
}

/// The step to third order from U xi, under v and a slew, in coordinates of the next shape.
VectorXd step_in_shape(const CurveDynamics& dynamics, const ShapeOnGrid& shape, Index phase,
                       const VectorXd& xi, const VectorXd& v, double slew) {
  const StepDerivatives& step = dynamics.step[static_cast<std::size_t>(phase)];
  const MatrixXd here = shape.here.col(phase).reshaped(2, 2);
  const MatrixXd next = shape.next.col(phase).reshaped(2, 2);
  const VectorXd x = here * xi;
  VectorXd all(4);
  all << x, v;
  VectorXd result = step.state * x + step.sample * v - slew * dynamics.slew.col(phase);
  for (Index row = 0; row < 2; ++row) {
    result[row] += 0.5 * all.dot(step.second[static_cast<std::size_t>(row)] * all);
    for (Index j = 0; j < 2; ++j) {
      for (Index k = 0; k < 2; ++k) {
        for (Index l = 0; l < 2; ++l) {
          result[row] += step.third(row, (j * 2 + k) * 2 + l) * x[j] * x[k] * x[l] / 6.0;
        }
      }
    }
  }
  return oracle::solution(next, result);
}

VectorXd direction_of(double angle) {
  return Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

TEST_CASE("no step to third order is longer than the bounds of its shape say") {
  test::Random random(50);
  double closest = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    const CurveDynamics dynamics = random_dynamics(random);
    const ShapeOnGrid shape = random_shape(random);
    const DisturbanceWeights weights{0.5, 0.25};
    const auto bounds = bound_along(dynamics, shape, weights);
    REQUIRE(bounds.has_value());
    for (Index phase = 0; phase < 3; ++phase) {
      const PhaseBounds& b = (*bounds)[static_cast<std::size_t>(phase)];
      for (int sample = 0; sample < 200; ++sample) {
        const double level = random.uniform(0.0, 1.0);
        const double noise = random.uniform(0.0, 0.5);
        const double slew = random.uniform(-0.5, 0.5);
        const VectorXd step =
            step_in_shape(dynamics, shape, phase, level * direction_of(random.uniform(0.0, 6.3)),
                          noise * direction_of(random.uniform(0.0, 6.3)), slew);
        const double linear = std::sqrt(std::pow(b.disturbed_rate * level, 2) +
                                        noise * noise / weights.noise + slew * slew / weights.slew);
        const double bound = linear + 0.5 * b.second * level * level + b.third * std::pow(level, 3) / 6.0 +
                             b.mixed * level * noise + 0.5 * b.sample * noise * noise;
        CHECK(step.norm() <= bound + 1e-12);
        closest = std::max(closest, step.norm() / bound);
      }
    }
  }
  CHECK(closest > 0.8);
}

TEST_CASE("the rate and the reach are attained in some direction") {
  test::Random random(51);
  const CurveDynamics dynamics = random_dynamics(random);
  const ShapeOnGrid shape = random_shape(random);
  const auto bounds = bound_along(dynamics, shape, {0.5, 0.25}).value();
  for (Index phase = 0; phase < 3; ++phase) {
    const auto at = static_cast<std::size_t>(phase);
    const MatrixXd here = shape.here.col(phase).reshaped(2, 2);
    const MatrixXd next = shape.next.col(phase).reshaped(2, 2);
    const MatrixXd to_next = oracle::solution(next, dynamics.step[at].state * here);
    double rate = 0.0, reach = 0.0, bend = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const VectorXd xi = direction_of(M_PI * i / 20000.0);
      rate = std::max(rate, (to_next * xi).norm());
      reach = std::max(reach, std::fabs(dynamics.gradient[at].dot(here * xi)));
      bend = std::max(bend, std::fabs((here * xi).dot(dynamics.hessian[at] * (here * xi))));
    }
    CHECK(bounds[at].rate == doctest::Approx(rate).epsilon(1e-7));
    CHECK(bounds[at].reach == doctest::Approx(reach).epsilon(1e-7));
    CHECK(bounds[at].straight == doctest::Approx(0.5 * reach / bend).epsilon(1e-7));
    CHECK(bounds[at].disturbed_rate >= bounds[at].rate);
  }
}

TEST_CASE("a shape with a vanishing diagonal is none, and weights may be too large") {
  test::Random random(52);
  const CurveDynamics dynamics = random_dynamics(random);
  ShapeOnGrid shape = random_shape(random);
  CHECK_FALSE(bound_along(dynamics, shape, {1000.0, 0.0}).has_value());
  CHECK_FALSE(bound_along(dynamics, shape, {0.0, 1000.0}).has_value());
  shape.next(3, 1) = 0.0;
  CHECK_FALSE(bound_along(dynamics, shape, {0.5, 0.25}).has_value());
}

}  // namespace
}  // namespace veritrack::model
