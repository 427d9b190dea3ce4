#include "analysis/model/set/tube_set.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "analysis/model/moving_frequency/moving_set.hpp"
#include "analysis/model/set/set_search.hpp"
#include "tests/analysis/model/set/level_checks.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Verdict;

TEST_CASE("a set for large starts: it covers the band, and every level is one") {
  const test::Example loop(test::phase_locked_loop());
  const TubeSet set = prove_set(test::tone_of(loop.tracker), loop.model, 0.28, 0.34,
                                {.name = "starts", .with_curve = true, .deviations = {}});
  REQUIRE(set.is_complete);
  CHECK(set.reasons.empty());
  CHECK(covers(set.tubes, 0.28, 0.34));
  CHECK_FALSE(covers(set.tubes, 0.27, 0.34));
  CHECK_FALSE(covers(set.tubes, 0.28, 0.35));
  CHECK_FALSE(covers({}, 0.28, 0.34));
  test::check_levels(loop.model, set);
  // Down to what the curve is known to.
  CHECK(set.tubes.front().levels.front() > 0.011);
  CHECK(set.tubes.front().levels.back() < 2e-5 * set.tubes.front().levels.front());
  const rigor::Interval mean =
      bound_errors(loop.model, set.tubes.front().tube, set.tubes.front().levels.back(), {128, 16}).mean;
  CHECK(mean.upper() - mean.lower() < 1e-8);
  for (const ProvedTube& proved : set.tubes) {
    CHECK(is_locked(loop.model, proved.tube, proved.levels.front()));
    CHECK_FALSE(is_locked(loop.model, proved.tube, 100.0));
  }
}

TEST_CASE("sets for noise: as much as is asked, as much as is found, and none for too much") {
  const test::Example loop(test::phase_locked_loop());
  const TrackedTone tone = test::tone_of(loop.tracker);
  SetTask task{
      .name = "assumed", .objective = ShapeObjective::largest_noise, .noise = 0.02, .deviations = {}};
  const TubeSet set = prove_set(tone, loop.model, 0.3, 0.31, task);
  REQUIRE(set.is_complete);
  CHECK(set.noise == 0.02);
  test::check_levels(loop.model, set);
  CHECK(set.tubes.front().levels.size() > 1);
  task.noise = 0.0;
  task.largest_noise = true;
  const TubeSet largest = prove_set(tone, loop.model, 0.3, 0.31, task);
  REQUIRE(largest.is_complete);
  CHECK(largest.noise > 0.04);
  test::check_levels(loop.model, largest);
  task.largest_noise = false;
  task.noise = 1.5 * largest.noise;
  const TubeSet none = prove_set(tone, loop.model, 0.3, 0.31, task);
  CHECK_FALSE(none.is_complete);
  CHECK(none.tubes.empty());
  REQUIRE_FALSE(none.reasons.empty());
  CHECK(none.reasons.front().find("no radius was proved for noise") != std::string::npos);
}

TEST_CASE("the search for the most finds no less than what was given, where the guess is far too large") {
  // The detector is so nearly linear that derivatives at the curve promise levels of many radians.
  test::Example loop(test::angle_loop());
  loop.signal = test::tone(loop.tracker.recursion.constants, true);
  const TrackedTone tone = test::tone_of(loop.tracker, true);
  SetTask task{
      .name = "assumed", .objective = ShapeObjective::largest_noise, .noise = 0.02, .deviations = {}};
  REQUIRE(prove_set(tone, loop.model, 0.2, 0.3, task).is_complete);
  task = {
      .name = "noise", .objective = ShapeObjective::largest_noise, .largest_noise = true, .deviations = {}};
  const TubeSet noise = prove_set(tone, loop.model, 0.2, 0.3, task);
  REQUIRE(noise.is_complete);
  CHECK(noise.noise > 0.025);
  test::check_levels(loop.model, noise);
  task = {.name = "slew", .objective = ShapeObjective::largest_slew, .slew = 1e-5, .deviations = {}};
  REQUIRE(prove_moving_set(tone, loop.model, 0.2, 0.3, task).is_complete);
  task.slew = 0.0;
  task.largest_slew = true;
  const TubeSet slew = prove_moving_set(tone, loop.model, 0.2, 0.3, task);
  REQUIRE(slew.is_complete);
  CHECK(slew.slew > 2e-5);
  test::check_levels(loop.model, slew);
}

TEST_CASE("what each cell tolerates on its own: at least what the set does, and that is proved") {
  const test::Example loop(test::phase_locked_loop());
  const TrackedTone tone = test::tone_of(loop.tracker);
  SetTask task{.name = "noise",
               .objective = ShapeObjective::largest_noise,
               .largest_noise = true,
               .of_each_cell = true,
               .deviations = {}};
  const TubeSet noise = prove_set(tone, loop.model, 0.2, 0.4, task);
  REQUIRE(noise.is_complete);
  REQUIRE(noise.tubes.size() > 1);
  test::check_levels(loop.model, noise);
  double least = INFINITY;
  double most = 0.0;
  for (const ProvedTube& proved : noise.tubes) {
    const LevelQuestion question{proved.levels.front(), proved.own_noise, 1.0, proved.shrinking.front()};
    CHECK(verify_level(loop.model, proved.tube, question, proved.grid).verdict == Verdict::proved);
    least = std::min(least, proved.own_noise);
    most = std::max(most, proved.own_noise);
  }
  CHECK(least == noise.noise);
  CHECK(most > least);
  task = {.name = "slew",
          .objective = ShapeObjective::largest_slew,
          .largest_slew = true,
          .of_each_cell = true,
          .deviations = {}};
  const TubeSet slew = prove_moving_set(tone, loop.model, 0.28, 0.32, task);
  REQUIRE(slew.is_complete);
  for (const ProvedTube& proved : slew.tubes) {
    CHECK(proved.own_slew >= slew.slew);
    const LevelQuestion question{proved.levels.front(), 0.0, 1.0, proved.shrinking.front(), proved.own_slew};
    CHECK(verify_level(loop.model, proved.tube, question, proved.grid).verdict == Verdict::proved);
  }
  // Without being asked, nothing is said of single cells.
  task.of_each_cell = false;
  CHECK(prove_moving_set(tone, loop.model, 0.3, 0.31, task).tubes.front().own_slew == 0.0);
}

/// The loop with a limit of 0.6 on its detector, whose values reach 0.5 in lock.
test::ExampleTracker limited_loop() {
  using trackers::Operation;
  test::ExampleTracker example = test::phase_locked_loop();
  example.recursion.constants = 4;  // ki, kp, the limits
  example.constants = {example.constants[0], example.constants[1], -0.6, 0.6};
  trackers::StraightLineProgram step(7);
  const int w = 4, theta = 5, y = 6;
  const int product = step.append(Operation::multiply, y, step.append(Operation::sin, theta));
  const int e = step.append(Operation::stays_within, step.append(Operation::negate, product), 2, 3);
  step.add_result(step.append(Operation::add, w, step.append(Operation::multiply, 0, e)));
  step.add_result(step.append(Operation::add, step.append(Operation::add, theta, w),
                              step.append(Operation::multiply, 1, e)));
  example.recursion.step = step;
  example.recursion.frequency = test::frequency_of_state(4, 2, 0);
  return example;
}

TEST_CASE("the reason names the operation that may be undefined in the tube") {
  const test::Example loop(limited_loop());
  TrackedTone tone = test::tone_of(loop.tracker);
  for (std::size_t i = 0; i < loop.tracker.recursion.step.instructions().size(); ++i) {
    tone.objections.push_back("operation " + std::to_string(i) + " may fail");
  }
  SetTask task{.name = "assumed", .objective = ShapeObjective::largest_noise, .noise = 0.3, .deviations = {}};
  const TubeSet none = prove_set(tone, loop.model, 0.3, 0.31, task);
  CHECK(none.tubes.empty());
  REQUIRE_FALSE(none.reasons.empty());
  CHECK_MESSAGE(
      none.reasons.front().find("operation 3 may fail with frequency errors up to") != std::string::npos,
      none.reasons.front());
  // Where the limit is far, it is not the reason.
  const test::Example free_loop(test::phase_locked_loop());
  TrackedTone free_tone = test::tone_of(free_loop.tracker);
  free_tone.objections.assign(free_loop.tracker.recursion.step.instructions().size(), "it may fail");
  const TubeSet noisy = prove_set(free_tone, free_loop.model, 0.3, 0.31, task);
  REQUIRE_FALSE(noisy.reasons.empty());
  CHECK(noisy.reasons.front().find("may fail") == std::string::npos);
}

TEST_CASE("how long levels take") {
  ProvedTube proved;
  proved.levels = {1.0, 0.5, 0.125};
  proved.shrinking = {0.99, 0.9};
  CHECK(samples_until(proved, 0) == 0.0);
  // ceil(ln 2 / -ln 0.99) = 69, ceil(ln 4 / -ln 0.9) = 14.
  CHECK(samples_until(proved, 1) == 69.0);
  CHECK(samples_until(proved, 2) == 83.0);
  // At borders levels shrink by less: ceil(ln 2 / -ln 0.995) = 139.
  CHECK(samples_until(proved, 1, {0.995, 0.5}) == 139.0);
  CHECK(samples_until(proved, 2, {0.995, 0.5}) == 153.0);
  proved.shrinking = {1.0, 0.9};
  CHECK_FALSE(std::isfinite(samples_until(proved, 1)));
}

}  // namespace
}  // namespace veritrack::model
