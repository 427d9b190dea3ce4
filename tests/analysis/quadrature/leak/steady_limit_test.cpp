// Sets of the largest noise and slew: proposed, verified, and run by the textbook filter.
#include "analysis/quadrature/leak/steady_limit.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/quadrature/leak/steady_verification.hpp"
#include "tests/analysis/quadrature/polar_simulation.hpp"
#include "tests/support/random.hpp"

namespace veritrack::quadrature {
namespace {

using rigor::Interval;
using rigor::Verdict;
using test::Polar;
using test::Simulation;

/// A tracker at one narrow band of frequencies.
struct NarrowBand {
  trackers::ToneModel<Interval> design{Interval(0.0013), Interval(0.0013), Interval(0.01), Interval(0.01)};
  sets::LockBranch branch;
  SteadyRequest request;

  NarrowBand() {
    const rigor::UpwardRounding upward;
    branch = sets::verify_lock_branch(design, Interval::from_bounds(0.5, 0.55), {.largest = 0.1});
    REQUIRE(branch.verdict == Verdict::proved);
    request.design = {0.0013, 0.0013, 0.01, 0.01};
    const Polar& x = branch.cells.back().center;
    request.steady = {{1.0 + x[0], x[1], x[2], {x[3], x[4], x[5], x[6], x[7], x[8]}}};
    request.slopes = {branch.cells.back().slope};
    request.evaluations = 25;
  }
};

constexpr double kTarget = 0.85;

TEST_CASE("the set of a limit is verified for it, and the textbook filter stays in it") {
  const NarrowBand example;
  SteadyRequest request = example.request;
  double SteadyRequest::*size = nullptr;
  SUBCASE("noise") {
    size = &SteadyRequest::noise;
  }
  SUBCASE("slew") {
    size = &SteadyRequest::slew;
  }
  const auto limit = propose_steady_limit(request, size, kTarget);
  REQUIRE(limit.has_value());
  request.*size = limit->size;
  const auto set = set_of_limit(request, *limit);
  REQUIRE(set.has_value());
  CHECK(set->levels.size() == 1);
  CHECK(set->noise == request.noise);
  CHECK(set->slew == request.slew);
  CHECK(verify_steady_set(example.design, example.branch.cells, *set).verdict == Verdict::proved);

  const rigor::NearestRounding nearest;
  test::Random random(93);
  const auto& cells = example.branch.cells;
  for (std::int64_t run = 0; run < test::effort(6); ++run) {
    Simulation simulation(example.design, Polar::Zero(), random.uniform(0.5, 0.55));
    const Eigen::Vector3d direction(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                    random.uniform(-1.0, 1.0));
    Polar start = test::steady_state(simulation, cells, example.design);
    start.head<3>() += set->metric.inverse() * direction.normalized();
    simulation = Simulation(example.design, start, simulation.frequency);
    double slew = set->slew;
    for (int k = 0; k < 40; ++k) {
      if (simulation.frequency + slew < 0.5 || simulation.frequency + slew > 0.55) {
        slew = -slew;
      }
      const double angle = random.uniform(0.0, 6.28);
      simulation.step(set->noise * Eigen::Vector2d(std::cos(angle), std::sin(angle)), slew);
      const Polar deviation = simulation.state() - test::steady_state(simulation, cells, example.design);
      CHECK((set->metric * deviation.head<3>()).norm() <= 1.0 + 1e-9);
    }
  }
}

TEST_CASE("more left for the proof is less noise, and much more noise than the limit has no set") {
  SteadyRequest request = NarrowBand().request;
  const auto limit = propose_steady_limit(request, &SteadyRequest::noise, kTarget);
  const auto cautious = propose_steady_limit(request, &SteadyRequest::noise, 0.8);
  REQUIRE(limit.has_value());
  REQUIRE(cautious.has_value());
  CHECK(limit->size > 1e-3);
  CHECK(cautious->size < limit->size);
  CHECK(cautious->size > 1e-3);
  request.noise = 3.0 * limit->size;
  CHECK_FALSE(set_of_limit(request, *limit).has_value());
}

TEST_CASE("no slew is proposed beside a noise that nothing tolerates") {
  SteadyRequest request = NarrowBand().request;
  request.noise = 1.0;
  CHECK_FALSE(propose_steady_limit(request, &SteadyRequest::slew, kTarget).has_value());
}

}  // namespace
}  // namespace veritrack::quadrature
