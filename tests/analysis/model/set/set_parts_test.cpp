#include "analysis/model/set/set_parts.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

#include "analysis/model/moving_frequency/moving_set.hpp"
#include "analysis/model/set/set_search.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

ProvedTube cell(double frequency, double half_width, int turns = 1) {
  ProvedTube proved;
  proved.tube.frequency = frequency;
  proved.tube.half_width = half_width;
  proved.tube.turns = {turns};
  return proved;
}

TEST_CASE("the widest part without gaps is kept, rounded inward, and all parts are told") {
  TubeSet set;
  set.tubes = {cell(0.75, 0.125), cell(0.25, 0.125), cell(1.0, 0.125 + 0x1p-40), cell(0.5, 0x1p-4)};
  keep_widest_part(set, 0.2, 1.1);
  CHECK_FALSE(set.is_complete);
  REQUIRE(set.parts.size() == 3);
  CHECK(set.parts[0].low == 0.2);
  CHECK(set.parts[0].high == 0.375);
  CHECK(set.parts[1].low == 0.4375);
  CHECK(set.parts[2].high == 1.1);
  REQUIRE(set.tubes.size() == 2);
  CHECK(set.tubes[0].tube.frequency == 0.75);
  CHECK(set.part.low == 0.625);
  CHECK(set.part.high == 1.1);
}

TEST_CASE("a gap of one rounding is a gap, and curves that turn otherwise are another part") {
  const std::vector<ProvedTube> touching{cell(0.25, 0.125), cell(0.5, 0.125)};
  CHECK(runs_of(touching, 0.125, 0.625).size() == 1);
  const std::vector<ProvedTube> apart{cell(0.25, 0.125), cell(0.5 + 0x1p-53, 0.125)};
  CHECK(runs_of(apart, 0.125, 0.625).size() == 2);
  const std::vector<ProvedTube> turning{cell(0.25, 0.125), cell(0.5, 0.125, 2)};
  CHECK(runs_of(turning, 0.125, 0.625).size() == 2);
  CHECK(runs_of({cell(0.25, 0.125)}, 0.5, 0.6).empty());
  CHECK(runs_of({}, 0.1, 0.2).empty());
  CHECK_THROWS_AS((void)widest({}), std::invalid_argument);
}

TEST_CASE("a set is complete when its tubes cover the band, and without tubes there is no part") {
  TubeSet set;
  set.tubes = {cell(0.25, 0.125), cell(0.5, 0.125)};
  keep_widest_part(set, 0.125, 0.625);
  CHECK(set.is_complete);
  TubeSet none;
  none.is_complete = true;
  keep_widest_part(none, 0.1, 0.2);
  CHECK_FALSE(none.is_complete);
  CHECK(none.parts.empty());
}

TEST_CASE("cells that failed alike are told together") {
  FailedCells failed;
  failed.add("nothing", 0.1, 0.2);
  failed.add("nothing", 0.2, 0.3);
  failed.add("another thing", 0.3, 0.4);
  failed.add("nothing", 0.4, 0.5);
  failed.add("nothing", 0.6, 0.7);
  CHECK(failed.reasons() == std::vector<std::string>{"nothing between 0.1 and 0.3 rad/sample",
                                                     "another thing between 0.3 and 0.4 rad/sample",
                                                     "nothing between 0.4 and 0.5 rad/sample",
                                                     "nothing between 0.6 and 0.7 rad/sample"});
}

TEST_CASE("when the time is over, what is proved is kept") {
  const test::Example loop(test::phase_locked_loop());
  const TrackedTone tone = test::tone_of(loop.tracker);
  SetTask task{.name = "starts", .deviations = {}};
  task.deadline = search::Deadline(1e-9);
  const TubeSet none = prove_set(tone, loop.model, 0.28, 0.34, task);
  CHECK(none.tubes.empty());
  REQUIRE_FALSE(none.reasons.empty());
  CHECK(none.reasons.front() == "stopped by the time limit, between 0.28 and 0.34 rad/sample");
  CHECK(task.deadline.has_struck());
  SetTask moving{
      .name = "assumed", .objective = ShapeObjective::largest_slew, .slew = 1e-5, .deviations = {}};
  moving.deadline = task.deadline;
  CHECK(prove_moving_set(tone, loop.model, 0.2, 0.4, moving).tubes.empty());
}

TEST_CASE("a band that goes on to where nothing is proved has a part" * doctest::test_suite("nightly")) {
  // Toward 0 the ripple of the loop grows beyond its tube.
  const test::Example loop(test::phase_locked_loop());
  const TrackedTone tone = test::tone_of(loop.tracker);
  const TubeSet set = prove_set(tone, loop.model, 0.002, 0.3, {.name = "starts", .deviations = {}});
  CHECK_FALSE(set.is_complete);
  REQUIRE_FALSE(set.tubes.empty());
  CHECK(set.part.low < 0.2);
  CHECK(set.part.high == 0.3);
  CHECK(covers(set.tubes, set.part.low, set.part.high));
  CHECK_FALSE(set.reasons.empty());
  for (const ProvedTube& proved : set.tubes) {
    CHECK(verify_level(loop.model, proved.tube, {proved.levels.front(), 0.0}, proved.grid).verdict ==
          rigor::Verdict::proved);
  }
}

}  // namespace
}  // namespace veritrack::model
