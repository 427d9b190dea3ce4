// The cautious rate against steps of the textbook filter.
#include "analysis/quadrature/leak/steady_cautious_rate.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "analysis/quadrature/leak/steady_samples.hpp"
#include "tests/analysis/quadrature/polar_simulation.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using test::Polar;
using test::Simulation;

TEST_CASE("no step of the textbook filter is longer than the cautious rate") {
  const trackers::ToneModel<Interval> design{Interval(0.0013), Interval(0.0013), Interval(0.01),
                                             Interval(0.01)};
  constexpr double kFrequency = 1.2;
  constexpr double kNoise = 0.002;
  const rigor::NearestRounding nearest;
  Polar guess;
  guess << 0.0, 0.0, 0.0, 0.003, 0.0, 0.0, 0.003, 0.002, 0.005;
  const sets::QuadraturePolarLoop loop{design};
  std::optional<sets::FixedPointProposal<9>> exact;
  for (int i = 1; i <= 24; ++i) {
    exact = sets::propose_fixed_point(loop, guess, kFrequency * i / 24.0);
    REQUIRE(exact.has_value());
    guess = exact->state;
  }
  const Polar& x = exact->state;
  SteadyRequest request;
  request.design = {0.0013, 0.0013, 0.01, 0.01};
  request.steady = {{1.0 + x[0], x[1], x[2], {x[3], x[4], x[5], x[6], x[7], x[8]}}};
  const SteadySamples samples(request, SteadyJudgement::cautious);
  test::Random random(94);
  const auto direction = [&] {
    return Eigen::Vector3d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0))
        .normalized();
  };
  double closest = 0.0;
  for (std::int64_t trial = 0; trial < test::effort(400); ++trial) {
    CAPTURE(trial);
    const double size = random.uniform(4.0, 20.0);
    const rigor::Matrix<3> metric = samples.metric(Eigen::VectorXd::Zero(5)) * size / 10.0;
    auto setting = samples.settings(metric).front();
    const Eigen::Matrix3d steady = setting.steady.covariance.matrix();
    const Eigen::Matrix3d band = random.uniform(0.01, 0.3) * steady;
    setting.band = {Symmetric<double>::from_matrix(band), Symmetric<double>::from_matrix(band)};
    // The error of u = T b, and the (x, y) that show it.
    const double level = random.uniform(0.1, 1.0);
    const Eigen::Vector3d u = random.uniform(0.5, 1.0) * direction();
    const Eigen::Vector3d b = metric.inverse() * u;
    const SteadyDirections<double>& d = setting.directions;
    const double seen_x = b[0] / d.a11;
    const SteadyPlace<double> place{level, seen_x, (b[1] + b[2] - d.a21 * seen_x) / d.a22};
    const SteadyStep<double> step = steady_step(setting, place);
    const SteadyBounds<double> bounds = steady_bounds(step, setting, level, kNoise);
    if (!(bounds.least_along > 0.05)) {
      continue;
    }
    const double rate = cautious_rate(setting, place, step, bounds, kNoise);
    Polar start = x;
    start.head<3>() += level * b;
    const Eigen::Vector3d axis = direction();
    const Eigen::Matrix3d root = oracle::cholesky_factor(band);
    const Eigen::Matrix3d p =
        steady +
        level * (root * (2.0 * axis * axis.transpose() - Eigen::Matrix3d::Identity()) * root.transpose());
    start.tail<6>() << p(0, 0), p(0, 1), p(0, 2), p(1, 1), p(1, 2), p(2, 2);
    Simulation simulation(design, start, kFrequency);
    const double angle = random.uniform(0.0, 6.28);
    simulation.step(kNoise * Eigen::Vector2d(std::cos(angle), std::sin(angle)), 0.0);
    const double length = (metric * (simulation.state() - x).head<3>()).norm() / level;
    CHECK(length <= rate * (1.0 + 1e-9));
    closest = std::max(closest, length / rate);
  }
  CHECK(closest > 0.5);
}

}  // namespace
}  // namespace veritrack::quadrature
