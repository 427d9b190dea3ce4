#include "analysis/rigor/taylor_lanes.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "analysis/rigor/taylor_model.hpp"
#include "tests/support/random.hpp"

namespace veritrack::rigor {
namespace {

using Model = TaylorModel<2, 4>;
using Lanes = TaylorLanes<2, 4, 2>;
using Set = IntervalLanes<2>;

double lane(const Lanes::Numbers& numbers, std::size_t i) {
  std::array<double, 2> all{};
  Registers<2>::store(all.data(), numbers);
  return all[i];
}

bool is_same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

void check_same(const Lanes& lanes, const std::array<Model, 2>& models) {
  for (std::size_t i = 0; i < 2; ++i) {
    CAPTURE(i);
    CHECK(is_same(lane(lanes.remainder(), i), models[i].remainder()));
    if (!is_known(models[i])) {
      continue;
    }
    for (std::size_t k = 0; k < Model::kTerms; ++k) {
      CAPTURE(k);
      CHECK(is_same(lane(lanes.coefficient(k), i), models[i].coefficients()[k]));
    }
    CHECK(is_same(lane(lanes.range().lower(), i), models[i].range().lower()));
    CHECK(is_same(lane(lanes.range().upper(), i), models[i].range().upper()));
  }
}

/// Two variables and an uncertain constant, in lanes and alone.
struct SideBySide {
  std::array<Model, 2> x, y, c;
  Lanes x_lanes, y_lanes, c_lanes;

  SideBySide(test::Random& random, double width) {
    std::array<double, 2> low{};
    std::array<double, 2> high{};
    const auto sides = [&] {
      for (std::size_t i = 0; i < 2; ++i) {
        low[i] = random.uniform(0.2, 1.0);
        high[i] = low[i] + width * random.uniform();
      }
      return Set::load(low.data(), high.data());
    };
    const auto alone = [&](std::size_t i) { return Interval::from_bounds(low[i], high[i]); };
    x_lanes = Lanes::variable(sides(), 0);
    x = {Model::variable(alone(0), 0), Model::variable(alone(1), 0)};
    y_lanes = Lanes::variable(sides(), 1);
    y = {Model::variable(alone(0), 1), Model::variable(alone(1), 1)};
    c_lanes = Lanes(sides());
    c = {Model(alone(0)), Model(alone(1))};
  }
};

template <typename Function>
void check_function(const SideBySide& all, const Function& function) {
  check_same(function(all.x_lanes, all.y_lanes, all.c_lanes),
             {function(all.x[0], all.y[0], all.c[0]), function(all.x[1], all.y[1], all.c[1])});
}

TEST_CASE("each lane is the Taylor model, to the bit") {
  const UpwardRounding upward;
  test::Random random(3);
  for (int n = 0; n < 300; ++n) {
    const SideBySide all(random, n % 2 == 0 ? 0.05 : 0.4);
    check_function(all, [](const auto& x, const auto& y, const auto& c) { return x * y - c * x; });
    check_function(all, [](const auto& x, const auto& y, const auto& c) {
      return sin_cos(x + c * y).first * sin_cos(y).second;
    });
    check_function(all, [](const auto& x, const auto& y, const auto& c) {
      const auto product = (x + y) * (x - c);
      return square(product) * product + product / (x + y + c);
    });
    check_function(all, [](const auto& x, const auto& y, const auto& c) {
      return (-(x * y * c)).polynomial() + reciprocal(square(x) + square(y));
    });
  }
}

TEST_CASE("what is not known in a lane is unknown there, and in no other") {
  const UpwardRounding upward;
  test::Random random(4);
  const SideBySide all(random, 0.1);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::array<double, 2> low{0.5, -kInfinity};
  const std::array<double, 2> high{0.6, 1.0};
  const Lanes odd(Set::load(low.data(), high.data()));
  check_same(odd * all.x_lanes, {Model(Interval::from_bounds(0.5, 0.6)) * all.x[0], Model()});
  // A divisor that contains zero in the second lane.
  const std::array<double, 2> from{0.5, -0.1};
  const std::array<double, 2> to{0.6, 0.1};
  const Lanes divisor = Lanes::variable(Set::load(from.data(), to.data()), 0);
  check_same(reciprocal(divisor), {reciprocal(Model::variable(Interval::from_bounds(0.5, 0.6), 0)), Model()});
  CHECK_FALSE(Registers<2>::bits(certainly_positive((reciprocal(divisor)).range())) == 3U);
}

}  // namespace
}  // namespace veritrack::rigor
