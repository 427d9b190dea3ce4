#include "analysis/model/tube/tube_verification.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/model/step/place_store.hpp"
#include "analysis/model/tube/tube_proposal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Verdict;
using test::Example;

Tube proposed(const Example& example, double frequency, double half_width, ShapeObjective objective) {
  TubeSettings settings;
  settings.shape.objective = objective;
  settings.largest_curve_error = 1e-7;
  const TubeProposal proposal = propose_tube(test::tone_of(example.tracker), frequency, half_width, settings);
  REQUIRE_MESSAGE(proposal.tube.has_value(), reason_of(proposal));
  return *proposal.tube;
}

/// Whether a state of this level can leave: the largest |F|/R that random places of the boundary reach, in
/// floating point. Shares no code with the verification: the recursion in doubles, sums of the tube's series.
class Attack {
 public:
  Attack(const Example& example, const Tube& tube) : example_(&example), tube_(tube), cell_(&tube) {}

  [[nodiscard]] double largest(double radius, double noise, int trials, double slew = 0.0) const {
    test::Random random(71);
    double worst = 0.0;
    const auto n = static_cast<Eigen::Index>(cell_->curve.size());
    for (int trial = 0; trial < trials; ++trial) {
      const double phase = random.uniform(0.0, 2.0 * M_PI);
      const double omega = cell_->frequency + cell_->half_width * random.uniform(-1.0, 1.0);
      Eigen::VectorXd xi(n);
      for (double& component : xi) {
        component = random.uniform(-1.0, 1.0);
      }
      const Eigen::VectorXd state =
          tube_.curve(phase, omega) + radius * tube_.shape(phase, omega) * xi.normalized();
      const double sample = std::cos(phase + omega) + (random.below(2) == 0 ? noise : -noise);
      const Eigen::VectorXd next = test::next_state(example_->tracker, state, sample);
      for (const double next_omega : {omega - slew, omega + slew}) {
        worst = std::max(worst, tube_.level(next, phase + omega, next_omega) / radius);
      }
    }
    return worst;
  }

 private:
  const Example* example_;
  test::PointTube tube_;
  const Tube* cell_;
};

TEST_CASE("a phase-locked loop: starts up to the aim are proved, and no attack leaves what is proved") {
  const Example loop(test::phase_locked_loop());
  const Tube tube = proposed(loop, 0.3, 0.04, ShapeObjective::largest_starts);
  const LevelResult proved = verify_level(loop.model, tube, {0.013, 0.0}, {});
  CHECK(proved.verdict == Verdict::proved);
  CHECK(proved.frequency_error.upper() > 0.0125);
  CHECK(proved.frequency_error.upper() < 0.0145);
  CHECK(proved.frequency_error.lower() < -0.0125);
  const Attack attack(loop, tube);
  const double worst = attack.largest(0.013, 0.0, 20000);
  CHECK(worst < 1.0);
  CHECK(worst > 0.9);
  // Beyond, an attack leaves or the verification says that it may.
  const LevelResult refused = verify_level(loop.model, tube, {0.02, 0.0}, {});
  CHECK(refused.verdict == Verdict::undecided);
  CHECK(refused.reason.find("a step may grow beyond the tube") != std::string::npos);
  CHECK(verify_level(loop.model, tube, {10.0, 0.0}, {}).verdict == Verdict::undecided);
  CHECK(verify_level(loop.model, tube, {0.013, 0.1}, {}).verdict == Verdict::undecided);
}

TEST_CASE("a set for noise, and levels that shrink to the curve without it") {
  const Example loop(test::phase_locked_loop());
  const Tube tube = proposed(loop, 0.3, 0.04, ShapeObjective::largest_noise);
  CHECK(verify_level(loop.model, tube, {0.0045, 0.04}, {}).verdict == Verdict::proved);
  CHECK(Attack(loop, tube).largest(0.0045, 0.04, 20000) < 1.0);
  LevelQuestion shrinks{0.004, 0.0, 0.25, 0.9999};
  while (shrinks.radius > 1e-6) {
    CAPTURE(shrinks.radius);
    CHECK(verify_level(loop.model, tube, shrinks, {}).verdict == Verdict::proved);
    shrinks.radius *= 0.25;
  }
  CHECK(verify_level(loop.model, tube, {0.004, 0.0, 0.25, 0.5}, {}).verdict == Verdict::undecided);
}

TEST_CASE("a frequency that moves is tolerated as far as the shape is made for, with noise and without") {
  struct Case {
    test::ExampleTracker tracker;
    double frequency, half_width, radius, slew, noise, slew_with_noise;
    VerificationBudget budget;
  };
  const double hertz = 2.0 * M_PI / 10000.0;
  // The aims at the curve are 5.5e-5, 3.1e-6 and 1.5e-5.
  for (const Case& c :
       {Case{test::phase_locked_loop(), 0.3, 0.04, 0.0078, 5.2e-5, 0.002, 5.0e-5, {64, 2, 20000}},
        Case{test::integrator_loop(), 50.0 * hertz, hertz, 0.0012, 2.5e-6, 0.001, 2.4e-6, {64, 2, 20000}},
        Case{test::notch_filter(), 0.5, 0.005, 0.0019, 1.1e-5, 0.0005, 1.0e-5, {128, 2, 20000}}}) {
    const Example example(c.tracker);
    const Tube tube = proposed(example, c.frequency, c.half_width, ShapeObjective::largest_slew);
    const Attack attack(example, tube);
    LevelQuestion question{c.radius, 0.0, 1.0, 1.0, c.slew};
    CHECK(verify_level(example.model, tube, question, c.budget).verdict == Verdict::proved);
    const double worst = attack.largest(c.radius, 0.0, 20000, c.slew);
    CHECK(worst < 1.0);
    CHECK(worst > 0.9);
    question.noise = c.noise;
    question.slew = c.slew_with_noise;
    CHECK(verify_level(example.model, tube, question, c.budget).verdict == Verdict::proved);
    CHECK(attack.largest(c.radius, c.noise, 20000, c.slew_with_noise) < 1.0);
    // Too much: an attack leaves, and nothing is proved.
    question = {c.radius, 0.0, 1.0, 1.0, 2.0 * c.slew};
    CHECK(verify_level(example.model, tube, question, c.budget).verdict == Verdict::undecided);
    CHECK(attack.largest(c.radius, 0.0, 20000, 3.0 * c.slew) > 1.0);
  }
}

TEST_CASE("more slew gives larger bounds, and hardly any costs hardly anything") {
  const Example loop(test::phase_locked_loop());
  const Tube tube = proposed(loop, 0.3, 0.04, ShapeObjective::largest_slew);
  const TubeCell cell{0.1, 0.01, 0.25, 0.1};
  for (const double noise : {0.0, 0.01}) {
    const StepBounds still = bound_step(loop.model, tube, cell, 0.008, noise, {1.0, 0.5});
    double last = still.steps[0];
    for (const double slew : {1e-12, 1e-6, 1e-5, 5e-5}) {
      const StepBounds moving = bound_step(loop.model, tube, cell, 0.008, noise, {1.0, 0.5}, slew);
      CHECK(moving.steps[0] > 0.9999 * last);
      CHECK(moving.frequency_error.upper() >= 0.9999999 * still.frequency_error.upper());
      last = moving.steps[0];
    }
    const StepBounds little = bound_step(loop.model, tube, cell, 0.008, noise, {1.0, 0.5}, 1e-12);
    CHECK(little.steps[0] < 1.001 * still.steps[0]);
  }
}

TEST_CASE("a SOGI-FLL and KalmANF reach the aims for starts") {
  const Example sogi(test::integrator_loop());
  const double hertz = 2.0 * M_PI / 10000.0;
  CHECK(verify_level(sogi.model, proposed(sogi, 50 * hertz, hertz, ShapeObjective::largest_starts),
                     {0.002, 0.0}, {})
            .verdict == Verdict::proved);
  const Example notch(test::notch_filter());
  CHECK(
      verify_level(notch.model, proposed(notch, 0.5, 0.005, ShapeObjective::largest_starts), {0.004, 0.0}, {})
          .verdict == Verdict::proved);
}

TEST_CASE("tubes that are wrong are not proved") {
  const Example loop(test::phase_locked_loop());
  const Tube good = proposed(loop, 0.3, 0.04, ShapeObjective::largest_starts);
  const LevelQuestion question{0.012, 0.0};
  REQUIRE(verify_level(loop.model, good, question, {}).verdict == Verdict::proved);
  const auto verdict = [&](const Tube& tube) { return verify_level(loop.model, tube, question, {}).verdict; };
  Tube wrong = good;
  wrong.curve[0].coefficients[0][0] += 0.004;
  CHECK(verdict(wrong) == Verdict::undecided);
  wrong = good;
  wrong.turns[1] = 0;
  CHECK(verdict(wrong) == Verdict::undecided);
  wrong = good;
  wrong.turns[1] = 2;
  CHECK(verdict(wrong) == Verdict::undecided);
  wrong = good;
  wrong.turns[0] = 1;
  CHECK(verdict(wrong) == Verdict::undecided);
  wrong = good;
  wrong.frequency += 0.1;
  CHECK(verdict(wrong) == Verdict::undecided);
  wrong = good;
  wrong.half_width = 0.4;
  CHECK(verdict(wrong) == Verdict::undecided);
  for (auto& harmonic : wrong.shape[0].coefficients) {
    for (auto& coefficient : harmonic) {
      coefficient = 0.0;
    }
  }
  CHECK(verdict(wrong) == Verdict::undecided);
  wrong = good;
  wrong.shape[2].coefficients[0][0] = std::nan("");
  CHECK(verdict(wrong) == Verdict::undecided);
  wrong = good;
  wrong.shape.pop_back();
  CHECK_THROWS_AS((void)verdict(wrong), std::invalid_argument);
  wrong = good;
  wrong.half_width = 0.0;
  CHECK_THROWS_AS((void)verdict(wrong), std::invalid_argument);
}

TEST_CASE("questions and budgets that cannot be answered are not proved") {
  const Example loop(test::phase_locked_loop());
  const Tube tube = proposed(loop, 0.3, 0.04, ShapeObjective::largest_starts);
  const auto verdict = [&](const LevelQuestion& question, const VerificationBudget& budget) {
    return verify_level(loop.model, tube, question, budget).verdict;
  };
  CHECK(verdict({0.0, 0.0}, {}) == Verdict::undecided);
  CHECK(verdict({std::nan(""), 0.0}, {}) == Verdict::undecided);
  CHECK(verdict({0.01, -1.0}, {}) == Verdict::undecided);
  CHECK(verdict({0.01, 0.0, 0.0, 1.0}, {}) == Verdict::undecided);
  CHECK(verdict({0.01, 0.0, 1.0, 1.5}, {}) == Verdict::undecided);
  CHECK(verdict({0.005, 0.0, 1.0, 1.0, -1e-6}, {}) == Verdict::undecided);
  CHECK(verdict({0.005, 0.0, 1.0, 1.0, std::nan("")}, {}) == Verdict::undecided);
  CHECK(verdict({0.005, 0.0, 1.0, 1.0, HUGE_VAL}, {}) == Verdict::undecided);
  CHECK(verdict({0.01, 0.0}, {3, 1, 1000}) == Verdict::undecided);
  CHECK(verdict({0.01, 0.0}, {0, 1, 1000}) == Verdict::undecided);
  // The same cells with any first grid that is fine enough.
  CHECK(verdict({0.01, 0.0}, {64, 2, 20000}) == Verdict::proved);
}

TEST_CASE("the coarsest grid is fine enough where it is tried, and the next coarser one is not") {
  const Example loop(test::phase_locked_loop());
  const Tube tube = proposed(loop, 0.3, 0.04, ShapeObjective::largest_starts);
  const LevelQuestion question{0.0125, 0.0, 0.5, 0.999};
  constexpr int kMost = 4096;
  const VerificationBudget first{1, 1, 20000};
  const auto grid = coarsest_grid(loop.model, tube, question, first, kMost);
  REQUIRE(grid.has_value());
  CAPTURE(grid->phases);
  CAPTURE(grid->frequencies);
  REQUIRE(grid->phases > 1);
  CHECK(growth_on_grid(loop.model, tube, question, *grid) <= question.shrinking);
  CHECK(growth_on_grid(loop.model, tube, question, first) > question.shrinking);
  // What is found is verified with few halvings, and what is kept of places changes nothing.
  const LevelResult result = verify_level(loop.model, tube, question, *grid);
  CHECK(result.verdict == Verdict::proved);
  const auto cells = static_cast<std::size_t>(grid->phases * grid->frequencies);
  CHECK(result.cells < 2 * cells);
  PlaceStore places(loop.model, tube, 1000);
  const auto again = coarsest_grid(loop.model, tube, question, first, kMost, &places);
  REQUIRE(again.has_value());
  CHECK(again->phases == grid->phases);
  CHECK(again->frequencies == grid->frequencies);
  // From that grid on it is this one; with fewer cells there is none, nor where a step grows.
  CHECK(coarsest_grid(loop.model, tube, question, *grid, 1).value().phases == grid->phases);
  const int fewer = grid->phases * grid->frequencies - 1;
  CHECK_FALSE(coarsest_grid(loop.model, tube, question, first, fewer).has_value());
  CHECK_FALSE(coarsest_grid(loop.model, tube, {0.02, 0.0, 0.5, 0.999}, first, kMost).has_value());
  VerificationBudget late = first;
  late.deadline = search::Deadline(0.0);
  CHECK_FALSE(coarsest_grid(loop.model, tube, question, late, kMost).has_value());
}

}  // namespace
}  // namespace veritrack::model
