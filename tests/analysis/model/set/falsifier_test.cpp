#include "analysis/model/set/falsifier.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>

#include "analysis/model/moving_frequency/moving_set.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

using test::Example;

TubeSet proved_for(const Example& example, double noise) {
  SetTask task;
  task.objective = noise > 0.0 ? ShapeObjective::largest_noise : ShapeObjective::largest_starts;
  task.noise = noise;
  return prove_set(test::tone_of(example.tracker), example.model, 0.28, 0.32, task);
}

TEST_CASE("starts on the rim come close to the proved bounds of a phase-locked loop, and stay below") {
  const Example loop(test::phase_locked_loop());
  for (const double noise : {0.0, 0.03}) {
    CAPTURE(noise);
    const TubeSet set = proved_for(loop, noise);
    REQUIRE(set.is_complete);
    const auto before = std::chrono::steady_clock::now();
    const TubeAttack attack = attack_tubes(loop.model, set);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - before;
    CHECK(seconds.count() < 5.0);  // most of a second is usual on a slow machine
    CHECK(attack.starts == 200);
    CHECK(attack.level_share <= 1.0);
    CHECK(attack.level_share > 0.85);
    double bound = 0.0;
    for (const ProvedTube& proved : set.tubes) {
      const rigor::Interval error = bound_errors(loop.model, proved.tube, proved.levels.front(), {}).error;
      bound = std::max({bound, error.upper(), -error.lower()});
    }
    CHECK(attack.frequency_error <= bound);
    CHECK(attack.frequency_error > 0.7 * bound);
    const TubeAttack again = attack_tubes(loop.model, set);
    CHECK(again.level_share == attack.level_share);
    CHECK(again.frequency_error == attack.frequency_error);
  }
}

TEST_CASE("a tube that is too large, or for less noise, is left") {
  const Example loop(test::phase_locked_loop());
  const AttackSettings quick{20, 200, 4, 1};
  TubeSet set = proved_for(loop, 0.03);
  REQUIRE(set.is_complete);
  set.noise *= 3.0;
  CHECK(attack_tubes(loop.model, set, quick).level_share > 1.0);
  TubeSet starts = proved_for(loop, 0.0);
  for (ProvedTube& proved : starts.tubes) {
    proved.levels.front() *= 8.0;
  }
  CHECK(attack_tubes(loop.model, starts, quick).level_share > 1.0);
  CHECK(attack_tubes(loop.model, {}, quick).starts == 0);
}

TEST_CASE("a frequency that moves up and down within its slew does not help, and a faster one does") {
  const Example loop(test::phase_locked_loop());
  SetTask task;
  task.objective = ShapeObjective::largest_slew;
  task.slew = 2e-5;
  TubeSet set = prove_moving_set(test::tone_of(loop.tracker), loop.model, 0.28, 0.32, task);
  REQUIRE(set.is_complete);
  const TubeAttack attack = attack_tubes(loop.model, set);
  CHECK(attack.level_share <= 1.0);
  CHECK(attack.level_share > 0.85);
  set.slew *= 10.0;
  CHECK(attack_tubes(loop.model, set, {20, 500, 4, 1}).level_share > 1.0);
}

TEST_CASE("a simulation begins on the rim and settles on the curve without noise") {
  const Example loop(test::phase_locked_loop());
  const TubeSet set = proved_for(loop, 0.0);
  REQUIRE(set.is_complete);
  const ProvedTube& proved = set.tubes.front();
  const Eigen::Vector2d start(proved.levels.front(), 0.0);
  const auto run =
      simulate_attack(loop.model, proved.tube, {proved.tube.frequency, 1.0, 0.0, 0.0}, start, 1500);
  REQUIRE(run.size() == 1501);
  CHECK(run.front().level == doctest::Approx(proved.levels.front()));
  CHECK(run.front().phase == 1.0);
  CHECK(run.back().level < 1e-4 * proved.levels.front());
  const auto noisy =
      simulate_attack(loop.model, proved.tube, {proved.tube.frequency, 1.0, 0.01, 0.0}, start, 1500);
  CHECK(noisy.back().level > run.back().level);
}

TEST_CASE("the tube in floating point is the tube") {
  const Example loop(test::phase_locked_loop());
  const TubeSet set = proved_for(loop, 0.0);
  REQUIRE(set.is_complete);
  const Tube& tube = set.tubes.front().tube;
  const test::PointTube other(tube);
  const double frequency = tube.frequency + 0.3 * tube.half_width;
  const PointTube points(tube, frequency);
  PointFrame frame;
  for (const double phase : {0.0, 1.0, 4.0, 30.0}) {
    points.at(phase, frame);
    CHECK((frame.curve - other.curve(phase, frequency)).norm() < 1e-12 * frame.curve.norm());
    CHECK((frame.shape - other.shape(phase, frequency)).norm() < 1e-12 * frame.shape.norm());
    const Eigen::Vector2d xi(0.01, -0.02);
    CHECK((frame.coordinates(frame.state(xi)) - xi).norm() < 1e-9);
  }
  PointTracker tracker(loop.model);
  const Eigen::VectorXd sample = tracker.samples(1.0);
  CHECK(sample[0] == doctest::Approx(std::cos(1.0)));
  CHECK((tracker.next(frame.curve, sample) - test::next_state(loop.tracker, frame.curve, sample[0])).norm() <
        1e-12);
}

}  // namespace
}  // namespace veritrack::model
