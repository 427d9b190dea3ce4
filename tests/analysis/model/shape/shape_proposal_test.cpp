#include "analysis/model/shape/shape_proposal.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/analysis/model/shape/shape_examples.hpp"

namespace veritrack::model {
namespace {

// x' = a x + b v + bend x^2/2. Every state |x| <= r stays there while a r + b V + bend r^2/2 <= r.
constexpr double kA = 0.9;
constexpr double kB = 0.5;
constexpr double kBend = 0.125;
constexpr double kDrift = 0.25;

std::optional<ShapeProposal> shape_for(ShapeObjective objective, double noise = 0.0) {
  ShapeSettings settings;
  settings.objective = objective;
  settings.noise = noise;
  return propose_shape(test::scalar_dynamics(kA, kB, kBend, kDrift), settings);
}

/// What is found is at most the optimum, and nearly it.
void check_optimum(double found, double optimum) {
  CHECK(found <= optimum * (1.0 + 1e-9));
  CHECK(found >= 0.97 * optimum);
}

TEST_CASE("of one state, the best shape tolerates what the best interval does") {
  const double room = 1.0 - kA;
  const auto starts = shape_for(ShapeObjective::largest_starts);
  REQUIRE(starts.has_value());
  check_optimum(starts->worth.reach, 2.0 * room / kBend);
  const auto noise = shape_for(ShapeObjective::largest_noise);
  REQUIRE(noise.has_value());
  check_optimum(noise->worth.noise, room * room / (2.0 * kBend * kB));
  const auto slew = shape_for(ShapeObjective::largest_slew);
  REQUIRE(slew.has_value());
  check_optimum(slew->worth.slew, room * room / (2.0 * kBend * kDrift));
  const auto settled = shape_for(ShapeObjective::least_long_run_error);
  REQUIRE(settled.has_value());
  CHECK(settled->worth.reach >= kB / room);
  CHECK(settled->worth.reach <= 1.03 * kB / room);
}

TEST_CASE("levels are in rad/sample, whatever the parameters, and a constant shape has no harmonics") {
  for (const ShapeObjective objective : {ShapeObjective::largest_starts, ShapeObjective::largest_noise}) {
    const auto found = shape_for(objective);
    REQUIRE(found.has_value());
    CHECK(found->harmonics == 0);
    CHECK(found->worth.level == found->worth.reach);
    // The shape of the parameters as they are has |grad h U| = 1.
    const CurveDynamics dynamics = test::scalar_dynamics(kA, kB, kBend, kDrift);
    const auto shape = shape_on_grid(dynamics, found->parameters, found->harmonics);
    REQUIRE(shape.has_value());
    CHECK(shape->here(0, 0) == doctest::Approx(1.0).epsilon(1e-9));
    CHECK(found->parameters.lambda > kA * kA);
    CHECK(found->parameters.lambda < 1.0);
  }
}

TEST_CASE("parameters that are good nearby lead to as good a shape, and searches repeat to the bit") {
  const auto first = shape_for(ShapeObjective::largest_noise);
  REQUIRE(first.has_value());
  const auto again = shape_for(ShapeObjective::largest_noise);
  CHECK(again->parameters.lambda == first->parameters.lambda);
  CHECK(again->parameters.source == first->parameters.source);
  CHECK(again->worth.score == first->worth.score);
  ShapeSettings settings;
  settings.objective = ShapeObjective::largest_noise;
  constexpr double kNear = 0.895;
  const auto near =
      propose_shape(test::scalar_dynamics(kNear, kB, kBend, kDrift), settings, first->parameters);
  REQUIRE(near.has_value());
  check_optimum(near->worth.noise, (1.0 - kNear) * (1.0 - kNear) / (2.0 * kBend * kB));
}

TEST_CASE("where errors do not shrink, or the time is over, there is no shape") {
  CHECK_FALSE(propose_shape(test::scalar_dynamics(1.001, kB, kBend), {}).has_value());
  ShapeSettings settings;
  settings.largest_rate = 1.0;
  CHECK_FALSE(propose_shape(test::scalar_dynamics(kA, kB, kBend), settings).has_value());
  settings.largest_rate = 0.0;
  settings.deadline = search::Deadline(0.0);
  CHECK_FALSE(propose_shape(test::scalar_dynamics(kA, kB, kBend), settings).has_value());
}

}  // namespace
}  // namespace veritrack::model
