#include "analysis/quadrature/leak/steady_rate.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

/// A step that leaves nothing, in the middle of its cell.
SteadyStep<SteadySecant> zero_step() {
  SteadyStep<SteadySecant> step;
  for (SteadySecant* entry : step.entries()) {
    *entry = SteadySecant(Interval(0.0));
  }
  step.hidden_squared = SteadySecant(Interval(1.0));
  return step;
}

struct Inequality {
  SteadyStep<SteadySecant> step = zero_step();
  std::array<Interval, 3> hidden{Interval(0.0), Interval(0.0), Interval(0.0)};
  SteadyCell cell{{-0.5, -0.5}, {0.5, 0.5}};
  double eta_rest = 0.0;
  double noise_squared = 0.0;

  [[nodiscard]] bool holds(const SteadyMultipliers& multipliers, double x = 0.0) const {
    SteadyBounds<Interval> bounds;
    bounds.eta_factor = Interval(1.0);
    bounds.eta_rest = Interval(eta_rest);
    SteadyOffset corner;
    corner.fill(Interval(0.0));
    corner[kX] = Interval(x);
    return certainly_contracts(step, bounds, hidden, cell, Interval(noise_squared), {corner}, Interval(0.81),
                               multipliers);
  }
};

TEST_CASE("multipliers that are not positive prove nothing, whatever they make of the matrix") {
  const rigor::UpwardRounding upward;
  const Inequality nothing;
  CHECK(nothing.holds({0.25, 0.5, 0.5}));
  CHECK_FALSE(nothing.holds({-0.25, 0.5, 0.5}));
  CHECK_FALSE(nothing.holds({0.25, -0.5, 0.5}));
  CHECK_FALSE(nothing.holds({0.25, 0.5, -0.5}));
  CHECK_FALSE(nothing.holds({1.0, 0.5, 0.5}));  // nothing is left of the rate
  CHECK(nothing.holds({0.25, 0.5, 0.5, 0.5}));
  CHECK_FALSE(nothing.holds({0.25, 0.5, 0.5, -0.125}));
  CHECK_FALSE(nothing.holds({0.25, 0.5, 0.5, 1.25}));  // the cell takes it all
}

TEST_CASE("a step contracts only when every part of it fits together with the others") {
  const rigor::UpwardRounding upward;
  const SteadyMultipliers multipliers{0.25, 0.5, 0.125};
  Inequality all;
  all.step.image[0] = SteadySecant(Interval(0.375));
  all.step.gram.p11 = SteadySecant(Interval(0.125));
  all.step.noise[0] = SteadySecant(Interval(0.125));
  all.step.eta_squared = SteadySecant(Interval(0.125));
  all.hidden[0] = Interval(0.125);
  all.eta_rest = 0.125;
  all.noise_squared = 0.25;
  // 0.375^2 / (0.81 - 0.25 - 0.125 - 0.03125) + 0.125^2 / 0.25 + 0.125 / 0.5 + 0.125^2 / 0.125 = 0.79.
  CHECK(all.holds(multipliers));
  SUBCASE("a larger image") {
    all.step.image[0] = SteadySecant(Interval(0.5));
  }
  SUBCASE("an image off the first axis") {
    all.step.image[2] = SteadySecant(Interval(0.75));
  }
  SUBCASE("more of what is hidden") {
    all.hidden[1] = Interval(0.75);
  }
  SUBCASE("a slope") {
    all.step.image[1] = SteadySecant(Interval(0.75)) * SteadySecant::variable(rigor::symmetric(1.0), 0.0, kY);
  }
  SUBCASE("a spread") {
    all.step.gram.p33 = SteadySecant(Interval(0.75));
  }
  SUBCASE("more of eta") {
    all.step.eta_squared = SteadySecant(Interval(1.0));
  }
  SUBCASE("more of eta by noise") {
    all.eta_rest = 1.0;
  }
  SUBCASE("a gain of noise") {
    all.step.noise[3] = SteadySecant(Interval(0.5));
  }
  SUBCASE("more noise") {
    all.noise_squared = 4.0;
  }
  CHECK_FALSE(all.holds(multipliers));
}

TEST_CASE("what holds in the middle of a cell must hold in its corners") {
  const rigor::UpwardRounding upward;
  Inequality cell;
  cell.step.eta_squared =
      SteadySecant(Interval(0.5)) * SteadySecant::variable(rigor::symmetric(2.0), 0.0, kX);
  CHECK(cell.holds({0.375, 0.5, 0.5}));
  CHECK_FALSE(cell.holds({0.375, 0.5, 0.5}, 2.0));
}

TEST_CASE("proposed multipliers bound the longest of random sums, and not by much more") {
  test::Random random(91);
  const auto vector = [&](double size) {
    return Eigen::Vector3d(random.uniform(-size, size), random.uniform(-size, size),
                           random.uniform(-size, size));
  };
  for (std::int64_t trial = 0; trial < test::effort(40); ++trial) {
    CAPTURE(trial);
    const Eigen::Vector3d image = vector(0.5);
    const Eigen::Vector3d hidden = vector(0.5);
    Eigen::Matrix3d spread;
    spread << vector(0.3), vector(0.3), vector(0.3);
    Eigen::Matrix<double, 3, 2> noise;
    noise << vector(0.3), vector(0.3);
    const double room = random.uniform(0.01, 1.0);
    const double eta = random.uniform(0.1, 1.0);
    const double v = random.uniform(0.1, 1.0);
    const SteadyReach reach{{image[0], image[1], image[2]},
                            {hidden[0], hidden[1], hidden[2]},
                            Symmetric<double>::from_matrix(spread * spread.transpose()),
                            Symmetric<double>::from_matrix(noise * noise.transpose()),
                            room,
                            eta * eta,
                            v * v};
    const double found = propose_rate(reach, 0.0).rate_squared;
    // In the direction d the sum is longest where each part points along d: climb by taking the sum as d.
    double longest = 0.0;
    for (int start = 0; start < 20; ++start) {
      Eigen::Vector3d d = start == 0 ? image : vector(1.0);
      for (int i = 0; i < 50; ++i) {
        d.normalize();
        const Eigen::Vector3d along_spread = spread.transpose() * d;
        const Eigen::Vector2d along_noise = noise.transpose() * d;
        const double sign = hidden.dot(d) < 0.0 ? -1.0 : 1.0;
        d = image + sign * std::sqrt(room) * hidden + eta * (spread * along_spread.normalized()) +
            v * (noise * along_noise.normalized());
        longest = std::max(longest, d.squaredNorm());
      }
    }
    CHECK(found >= longest * (1.0 - 1e-9));
    CHECK(found <= 1.5 * longest);
  }
}

TEST_CASE("three entries of a matrix decide together whether it is definite") {
  const rigor::UpwardRounding upward;
  const auto definite = [](double p11, double p12, double p13, double p22, double p23, double p33) {
    return certainly_positive_definite(Symmetric<Interval>{Interval(p11), Interval(p12), Interval(p13),
                                                           Interval(p22), Interval(p23), Interval(p33)});
  };
  CHECK(definite(1.0, 0.5, 0.5, 1.0, 0.5, 1.0));
  CHECK_FALSE(definite(-1.0, 0.0, 0.0, 1.0, 0.0, 1.0));
  CHECK_FALSE(definite(1.0, 1.5, 0.0, 1.0, 0.0, 1.0));
  CHECK_FALSE(definite(1.0, 0.0, 1.5, 1.0, 0.0, 1.0));
  CHECK_FALSE(definite(1.0, 0.0, 0.0, 1.0, 1.5, 1.0));
  CHECK_FALSE(definite(1.0, 0.9, 0.9, 1.0, -0.9, 1.0));
}

}  // namespace
}  // namespace veritrack::quadrature
