// The two inequalities of a step about the steady state, each broken in one of its parts.
#include "checker/quadrature/steady_rate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace veritrack::checker;

namespace {

Row<Ball> row_of_zeros() {
  Row<Ball> row;
  row.fill(zero);
  return row;
}

const Multipliers kMultipliers{0.25, 0.5, 0.125, 0.0};

SteadyLimits limits_of(double noise_squared = 0.0) {
  SteadyLimits limits;
  limits.rate_squared = Ball(0.81);
  limits.noise_squared = Ball(noise_squared);
  limits.hidden = {zero, zero, zero};
  for (auto& row : limits.slopes) {
    row = {zero, zero};
  }
  limits.middle = {zero, zero};
  limits.size_squared = zero;
  return limits;
}

bool contracts(const Row<Ball>& row, const SteadyLimits& limits, const Multipliers& multipliers) {
  return ErrorInequality(limits, multipliers).contracts(row);
}

/// A step of a cell with everything in it.
struct Example {
  Row<Ball> row = row_of_zeros();
  SteadyLimits limits = limits_of(0.25);
  Example() {
    row[0] = Ball(0.05);
    row[1] = Ball(-0.02);
    row[kGram] = row[kGram + 3] = row[kGram + 5] = Ball(0.01);
    row[kNoise] = Ball(0.2);
    row[kNoise + 3] = Ball(0.1);
    row[kEta] = Ball(0.5);
    limits.hidden = {Ball(0.1), Ball(0.1), Ball(0.3)};
    limits.slopes = {{{Ball(0.5), Ball(0.125)}, {Ball(-0.25), Ball(0.5)}, {zero, Ball(0.25)}}};
  }
  void set_cell(double x, double y, double size) {
    limits.middle = {Ball(x), Ball(y)};
    limits.size_squared = Ball(size * size);
  }
};

/// The longest step of a cell that is found by trying, in double: |p + S (x, y) + t hidden + B y + N v|.
double longest(const Example& example, double x, double y, double size) {
  std::mt19937 random(20261123);
  std::normal_distribution<double> normal;
  const auto& s = example.limits.slopes;
  double most = 0.0;
  for (int i = 0; i < 20000; ++i) {
    std::array<double, 2> d{normal(random), normal(random)};
    const double length = std::hypot(d[0], d[1]);
    const std::array<double, 2> at{x + size * d[0] / length, y + size * d[1] / length};
    const double room = 1.0 - at[0] * at[0] - at[1] * at[1];
    if (room < 0.0) {
      continue;
    }
    const double t = std::sqrt(room) * (i % 2 == 0 ? 1.0 : -1.0);
    std::array<double, 3> spread{normal(random), normal(random), normal(random)};
    const double spread_length =
        std::sqrt(spread[0] * spread[0] + spread[1] * spread[1] + spread[2] * spread[2]);
    const double angle = normal(random);
    const std::array<double, 2> v{0.5 * std::cos(angle), 0.5 * std::sin(angle)};
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double image =
          example.row[k].near() + s[k][0].near() * at[0] + s[k][1].near() * at[1] +
          t * example.limits.hidden[k].near() + 0.1 * std::sqrt(0.5) * spread[k] / spread_length +
          example.row[kNoise + 2 * k].near() * v[0] + example.row[kNoise + 2 * k + 1].near() * v[1];
      sum += image * image;
    }
    most = std::max(most, std::sqrt(sum));
  }
  return most;
}

}  // namespace

TEST_CASE("a step contracts only when every part of it fits together with the others") {
  Row<Ball> row = row_of_zeros();
  SteadyLimits limits = limits_of(0.25);
  limits.hidden[0] = Ball(0.125);
  row[0] = Ball(0.5);
  row[kGram] = Ball(0.125);
  row[kNoise] = Ball(0.125);
  row[kEta] = Ball(0.25);
  // 0.5^2/(0.81 - 0.25 - 0.125 - 0.03125) + 0.125^2/0.25 + 0.125/0.5 + 0.125^2/0.125 = 1.06: too much, and
  // 0.79 with a smaller image.
  CHECK(!contracts(row, limits, kMultipliers));
  row[0] = Ball(0.375);
  CHECK(contracts(row, limits, kMultipliers));
  SUBCASE("an image off the first axis") {
    row[2] = Ball(0.75);
  }
  SUBCASE("more of what is hidden") {
    limits.hidden[1] = Ball(0.75);
  }
  SUBCASE("slopes") {
    limits.slopes[2][1] = Ball(0.75);
  }
  SUBCASE("a spread") {
    row[kGram + 5] = Ball(0.75);
  }
  SUBCASE("more of eta") {
    row[kEta] = Ball(1.25);
  }
  SUBCASE("a gain of noise") {
    row[kNoise + 3] = Ball(0.5);
  }
  SUBCASE("more noise") {
    limits.noise_squared = Ball(4.0);
  }
  CHECK(!contracts(row, limits, kMultipliers));
}

TEST_CASE("in a small cell slopes count with the middle of the cell and with its size") {
  Row<Ball> row = row_of_zeros();
  SteadyLimits limits = limits_of();
  limits.slopes[0][0] = Ball(1.0);
  const Multipliers multipliers{0.25, 0.5, 0.125, 15.75};  // theta = 63/64
  // theta^2 |S q|^2/h + 1/16 < 1 with h = 0.81 - 0.25 + 0.25 theta |q|^2 - 15.75 size^2.
  limits.middle[0] = Ball(0.5);
  limits.size_squared = Ball(1.0 / 64);  // 0.242/0.375 + 0.0625 = 0.71
  CHECK(contracts(row, limits, multipliers));
  SUBCASE("a middle farther out") {
    limits.middle[0] = Ball(0.75);  // 0.545/0.452 + 0.0625
  }
  SUBCASE("a larger cell") {
    limits.size_squared = Ball(1.0 / 40);  // 0.242/0.228 + 0.0625
  }
  SUBCASE("a steeper slope") {
    limits.slopes[0][0] = Ball(1.25);  // 0.378/0.375 + 0.098
  }
  SUBCASE("something there already") {
    row[0] = Ball(0.125);  // 0.617^2/0.375 + 0.0625
  }
  CHECK(!contracts(row, limits, multipliers));
}

TEST_CASE("multipliers that are not positive prove nothing") {
  const Row<Ball> row = row_of_zeros();
  const SteadyLimits limits = limits_of(0.25);
  CHECK(contracts(row, limits, kMultipliers));
  CHECK(!contracts(row, limits, {-0.25, 0.5, 0.125, 0.0}));
  CHECK(!contracts(row, limits, {0.25, -0.5, 0.125, 0.0}));
  CHECK(!contracts(row, limits, {0.25, 0.5, -0.125, 0.0}));
  CHECK(!contracts(row, limits, {0.25, 0.5, 0.125, -0.0625}));
  CHECK(!contracts(row, limits, {1.0, 0.5, 0.125, 0.0}));  // nothing is left of the rate
  CHECK(!contracts(row, limits, {NAN, 0.5, 0.125, 0.0}));
  CHECK(!contracts(row, limits, {0.25, 0.5, 0.125, NAN}));
}

TEST_CASE("proposed multipliers prove a cell up to little more than the longest step in it, and never less") {
  for (const auto& [x, y, size] : {std::array{0.0, 0.0, 1.0}, {0.5, 0.25, 0.25}, {-0.5, 0.5, 0.0625}}) {
    CAPTURE(x);
    CAPTURE(size);
    Example example;
    example.set_cell(x, y, size);
    const double found = longest(example, x, y, size);
    const auto is_proved = [&](double rate) {
      example.limits.rate_squared = Ball(rate * rate);
      return contracts(example.row, example.limits, propose(example.row, example.limits).multipliers);
    };
    CHECK(!is_proved(found));
    // The hidden part, the spread, and the noise need not be at their worst together, nor is the cell a disc
    // only where the unit disc allows it.
    CHECK(is_proved(1.25 * found));
  }
}

TEST_CASE("the derivatives of the proposed rate are those by the entries of the row") {
  Example example;
  example.set_cell(0.25, -0.25, 0.125);
  const Proposal proposal = propose(example.row, example.limits);
  for (std::size_t i = 0; i < kColumns; ++i) {
    CAPTURE(i);
    const auto rate_with = [&](double change) {
      Row<Ball> row = example.row;
      row[i] += Ball(change);
      return propose(row, example.limits).rate_squared;
    };
    constexpr double kStep = 1e-3;
    const double slope = (rate_with(kStep) - rate_with(-kStep)) / (2.0 * kStep);
    CHECK(proposal.weights[i] == doctest::Approx(slope).epsilon(0.05).scale(1.0));
  }
}

TEST_CASE("the covariance is kept on both sides, and so far as it may turn either way") {
  SteadySetting setting;
  setting.below = {Ball(1.0), zero, zero, Ball(1.0), zero, Ball(1.0)};
  setting.above = {Ball(2.0), zero, zero, Ball(2.0), zero, Ball(2.0)};
  const Symmetric<Ball> low{Ball(-0.5), zero, zero, Ball(-0.5), zero, Ball(-0.5)};
  const Symmetric<Ball> high{Ball(1.5), zero, zero, Ball(1.5), zero, Ball(1.5)};
  const Symmetric<Ball> none{zero, zero, zero, zero, zero, zero};
  const Symmetric<Ball> little{Ball(0.125), zero, zero, Ball(-0.125), Ball(0.125), zero};
  CHECK(keeps_covariance(low, high, {little, little}, setting, one));
  CHECK(!keeps_covariance(low, high, {none, none}, setting, Ball(0.7)));  // not below 1.4 above
  CHECK(!keeps_covariance(low, high, {none, none}, setting, Ball(0.4)));
  CHECK(!keeps_covariance(low, high, {none, none}, setting, Ball(-1.0)));
  for (const double sign : {-1.0, 1.0}) {
    const Symmetric<Ball> far{Ball(0.75 * sign), zero, zero, zero, zero, zero};
    CHECK(!keeps_covariance(low, high, {far, none}, setting, one));
    CHECK(!keeps_covariance(low, high, {none, far}, setting, one));
  }
  Symmetric<Ball> lower = low;
  lower[3] = Ball(-1.25);
  CHECK(!keeps_covariance(lower, high, {none, none}, setting, one));
  Symmetric<Ball> higher = high;
  higher[5] = Ball(2.25);
  CHECK(!keeps_covariance(low, higher, {none, none}, setting, one));
}
