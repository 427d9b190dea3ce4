#include "analysis/model/moving_frequency/moving_set.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "analysis/model/moving_frequency/border.hpp"
#include "tests/analysis/model/set/level_checks.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Verdict;

TEST_CASE("sets for a frequency that moves have equal levels, and their borders are proved") {
  const test::Example loop(test::phase_locked_loop());
  const TrackedTone tone = test::tone_of(loop.tracker);
  SetTask task{.name = "assumed",
               .objective = ShapeObjective::largest_noise,
               .noise = 0.01,
               .slew = 1e-5,
               .deviations = {}};
  const TubeSet set = prove_moving_set(tone, loop.model, 0.2, 0.4, task);
  REQUIRE(set.is_complete);
  CHECK(set.slew == 1e-5);
  REQUIRE(set.tubes.size() > 1);
  test::check_levels(loop.model, set);
  REQUIRE(set.crossing.size() == set.tubes.front().shrinking.size());
  for (std::size_t i = 0; i + 1 < set.tubes.size(); ++i) {
    CHECK(set.tubes[i].levels == set.tubes[i + 1].levels);
    for (std::size_t j = 0; j < set.crossing.size(); ++j) {
      CHECK(set.crossing[j] < 1.0);
      const double radius = set.tubes[i].levels[j];
      const BorderQuestion question{set.tubes[i].shrinking[j] * radius, set.crossing[j] * radius, set.slew,
                                    1.0};
      CHECK(verify_border(loop.model, set.tubes[i].tube, set.tubes[i + 1].tube, question, {}).verdict ==
            Verdict::proved);
    }
  }
  task.slew = 1e-3;
  CHECK_FALSE(prove_moving_set(tone, loop.model, 0.2, 0.4, task).is_complete);
}

TEST_CASE("a moving set tells how far it is") {
  const test::Example loop(test::phase_locked_loop());
  const TrackedTone tone = test::tone_of(loop.tracker);
  const SetTask task{.name = "assumed",
                     .objective = ShapeObjective::largest_noise,
                     .noise = 0.01,
                     .slew = 1e-5,
                     .deviations = {}};
  std::vector<double> told;
  (void)prove_moving_set(tone, loop.model, 0.25, 0.3, task, [&](double share) { told.push_back(share); });
  REQUIRE(told.size() >= 3);
  CHECK(std::is_sorted(told.begin(), told.end()));
  CHECK(told.front() > 0.0);
  CHECK(told.front() < 1.0);
  CHECK(told.back() == 1.0);
}

TEST_CASE("where a tracker locks over a part of the band only, the largest slew is found there") {
  test::Example loop(test::phase_locked_loop());
  TrackedTone tone = test::tone_of(loop.tracker);
  // From 0.39 on it begins nowhere.
  tone.start = [](double omega) { return std::vector<double>{omega < 0.39 ? omega : std::nan(""), 0.0}; };
  const SetTask task{
      .name = "slew", .objective = ShapeObjective::largest_slew, .largest_slew = true, .deviations = {}};
  const TubeSet set = prove_moving_set(tone, loop.model, 0.3, 0.5, task);
  CHECK_FALSE(set.is_complete);
  CHECK_FALSE(set.reasons.empty());
  REQUIRE_FALSE(set.tubes.empty());
  CHECK(set.slew > 1e-5);
  CHECK(set.part.low == 0.3);
  CHECK(set.part.high < 0.45);
}

}  // namespace
}  // namespace veritrack::model
