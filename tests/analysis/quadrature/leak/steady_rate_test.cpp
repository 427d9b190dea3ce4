#include "analysis/quadrature/leak/steady_rate.hpp"

#include <doctest/doctest.h>

#include <cstddef>

namespace veritrack::quadrature {
namespace {

using rigor::Interval;

/// A step without constant, slope and spread: zero.
SteadyStep<SteadySecant> zero_step() {
  SteadyStep<SteadySecant> step;
  for (SteadySecant* entry : step.entries()) {
    *entry = SteadySecant(Interval(0.0));
  }
  return step;
}

bool contracts(const SteadyStep<SteadySecant>& step, const SteadyRate& multipliers, double gram_rest = 0.0) {
  SteadyBounds<Interval> bounds;
  bounds.gram_factor = Interval(1.0);
  bounds.gram_rest = Interval(gram_rest);
  SteadyOffset middle;
  middle.fill(Interval(0.0));
  return certainly_contracts(step, bounds, step.eta_squared.range(), {middle}, Interval(0.81), multipliers);
}

SteadyRate multipliers_of(double spread, double error) {
  SteadyRate rate{};
  rate.spread_multiplier = spread;
  rate.error_multiplier = error;
  return rate;
}

TEST_CASE("multipliers that are not positive prove nothing, whatever they make of the matrix") {
  const rigor::UpwardRounding upward;
  const SteadyStep<SteadySecant> step = zero_step();
  CHECK(contracts(step, multipliers_of(0.5, 0.25)));
  CHECK_FALSE(contracts(step, multipliers_of(-0.5, 0.25)));
  CHECK_FALSE(contracts(step, multipliers_of(0.5, -0.25)));
  CHECK_FALSE(contracts(step, multipliers_of(0.5, 1.0)));  // nothing is left of the rate
}

TEST_CASE("a step contracts only when every part of it fits together with the others") {
  const rigor::UpwardRounding upward;
  const SteadyRate multipliers = multipliers_of(0.5, 0.25);
  SteadyStep<SteadySecant> step = zero_step();
  step.constant[0] = SteadySecant(Interval(0.375));
  step.slope[0] = SteadySecant(Interval(0.25));
  step.gram.p11 = SteadySecant(Interval(0.125));
  step.eta_squared = SteadySecant(Interval(0.25));
  // 0.375^2 / (0.81 - 0.25 - 0.125) + 0.25^2 / 0.25 + 0.125 / 0.5 = 0.82.
  CHECK(contracts(step, multipliers));
  CHECK_FALSE(contracts(step, multipliers, 0.1));
  SUBCASE("a larger constant") {
    step.constant[0] = SteadySecant(Interval(0.5));
  }
  SUBCASE("a constant off the first axis") {
    step.constant[2] = SteadySecant(Interval(0.75));
  }
  SUBCASE("a slope") {
    step.slope[4] = SteadySecant(Interval(0.75));
  }
  SUBCASE("a spread") {
    step.gram.p33 = SteadySecant(Interval(0.75));
  }
  SUBCASE("more of eta") {
    step.eta_squared = SteadySecant(Interval(1.0));
  }
  CHECK_FALSE(contracts(step, multipliers));
}

TEST_CASE("what holds in the middle of a cell must hold in its corners") {
  const rigor::UpwardRounding upward;
  SteadyStep<SteadySecant> step = zero_step();
  step.constant[1] = SteadySecant(Interval(0.5)) * SteadySecant::variable(rigor::symmetric(2.0), 0.0, kX);
  SteadyBounds<Interval> bounds;
  bounds.gram_factor = Interval(1.0);
  bounds.gram_rest = Interval(0.0);
  const auto at = [&](double x) {
    SteadyOffset corner;
    corner.fill(Interval(0.0));
    corner[kX] = Interval(x);
    return certainly_contracts(step, bounds, Interval(0.0), {corner}, Interval(0.81),
                               multipliers_of(0.5, 0.25));
  };
  CHECK(at(0.0));
  CHECK_FALSE(at(2.0));
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
