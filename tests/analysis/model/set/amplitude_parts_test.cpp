// A constant amplitude in a range: parts of the range that cover it, and sets that are proved part by part.
#include "analysis/model/set/amplitude_parts.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/model/set/falsifier.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using test::Example;

TEST_CASE("equal parts cover a range, from low amplitudes to high ones without gaps") {
  for (const Interval& range : {Interval::from_bounds(0.9, 1.1), Interval::from_bounds(1e-300, 1.0),
                                Interval::from_bounds(1.0, 1.0 + 1e-12)}) {
    for (const std::size_t count : {1U, 2U, 3U, 7U, 48U}) {
      CAPTURE(count);
      const std::vector<AmplitudeRange> parts = equal_parts(range, count);
      REQUIRE(parts.size() == count);
      CHECK(parts.front().low < range.lower());
      CHECK(parts.front().low > 0.0);
      CHECK(parts.back().high > range.upper());
      for (std::size_t k = 0; k < count; ++k) {
        CHECK(parts[k].low < parts[k].high);
        CHECK((k == 0 || parts[k].low == parts[k - 1].high));
      }
    }
  }
  const double largest = std::numeric_limits<double>::max();
  CHECK(equal_parts(Interval::from_bounds(1.0, largest), 3).back().high == largest);
  CHECK_THROWS_AS((void)equal_parts(Interval::from_bounds(0.9, 1.1), 0), std::invalid_argument);
  CHECK_THROWS_AS((void)equal_parts(Interval(1.0), 2), std::invalid_argument);
  CHECK_THROWS_AS((void)equal_parts(Interval::empty(), 2), std::invalid_argument);
  CHECK_THROWS_AS((void)equal_parts(Interval::from_bounds(1.0, INFINITY), 2), std::invalid_argument);
}

ProvedTube tube_at(double frequency, double half_width) {
  ProvedTube proved;
  proved.tube.frequency = frequency;
  proved.tube.half_width = half_width;
  proved.levels = {0.5};
  return proved;
}

TubeSet set_over(double low, double high, double noise) {
  TubeSet set;
  set.name = "noise";
  set.noise = noise;
  set.slew = 0.25;
  set.tubes = {tube_at(0.5 * (low + high), 0.5 * (high - low))};
  set.part = {low, high};
  set.is_complete = true;
  set.crossing = {noise};
  return set;
}

TEST_CASE("a set of all parts is for the least noise, and for the frequencies that all have") {
  const std::vector<AmplitudeRange> parts{{0.75, 1.0}, {1.0, 1.25}, {1.25, 1.5}};
  std::vector<TubeSet> sets{set_over(0.25, 0.5, 0.5), set_over(0.25, 0.5, 0.125), set_over(0.25, 0.5, 0.25)};
  const TubeSet all = join_amplitudes(sets, parts);
  CHECK(all.is_complete);
  CHECK(all.noise == 0.125);
  CHECK(all.slew == 0.25);
  CHECK(all.tubes.size() == 3);
  const std::vector<TubeSet> again = sets_of_amplitudes(all);
  REQUIRE(again.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(again[k].noise == 0.125);
    CHECK(again[k].crossing == sets[k].crossing);
    CHECK(again[k].tubes.front().tube == sets[k].tubes.front().tube);
    REQUIRE(again[k].amplitudes.size() == 1);
    CHECK(again[k].amplitudes.front().low == parts[k].low);
    const TrackerModel tracker = on_amplitudes_of({}, again[k]);
    CHECK(tracker.amplitude_varies);
    CHECK(tracker.amplitude.lower() == parts[k].low);
    CHECK(tracker.amplitude.upper() == parts[k].high);
    CHECK(sets_of_amplitudes(again[k]).size() == 1);
  }
  CHECK_THROWS_AS((void)on_amplitudes_of({}, all), std::invalid_argument);
  // A part of which less is proved.
  sets[1] = set_over(0.375, 0.5, 0.5);
  sets[1].is_complete = false;
  sets[1].reasons = {"no radius was proved"};
  const TubeSet some = join_amplitudes(sets, parts);
  CHECK_FALSE(some.is_complete);
  CHECK(some.tubes.size() == 3);
  CHECK(some.part.low == 0.375);
  CHECK(some.part.high == 0.5);
  REQUIRE(some.reasons.size() == 1);
  CHECK(some.reasons.front() == "at amplitudes from 1 to 1.25: no radius was proved");
  // One of which nothing is, or nothing in common with another.
  sets[1].tubes.clear();
  CHECK(join_amplitudes(sets, parts).tubes.empty());
  CHECK_FALSE(join_amplitudes(sets, parts).is_complete);
  sets[1] = set_over(0.5, 0.75, 0.5);
  CHECK(join_amplitudes(sets, parts).tubes.empty());
  CHECK_FALSE(join_amplitudes(sets, parts).is_complete);
  // Equal reasons of neighbours are one.
  for (TubeSet& set : sets) {
    set.is_complete = false;
    set.reasons = {"no radius was proved"};
  }
  CHECK(join_amplitudes(sets, parts).reasons ==
        std::vector<std::string>{"at amplitudes from 0.75 to 1.5: no radius was proved"});
  CHECK_THROWS_AS((void)join_amplitudes({}, {}), std::invalid_argument);
  CHECK_THROWS_AS((void)join_amplitudes(sets, {{0.75, 1.0}}), std::invalid_argument);
}

TEST_CASE("a set without parts is one") {
  const TubeSet set = set_over(0.25, 0.5, 0.5);
  REQUIRE(sets_of_amplitudes(set).size() == 1);
  TrackerModel tracker;
  tracker.amplitude = Interval(2.0);
  CHECK(on_amplitudes_of(tracker, set).amplitude.lower() == 2.0);
  CHECK_FALSE(on_amplitudes_of(tracker, set).amplitude_varies);
}

TEST_CASE("a wider range takes more parts, and what is proved of each is not left") {
  const Example loop(test::phase_locked_loop());
  const auto tone_at = [&](double amplitude, double deviation) {
    TrackedTone tone = test::tone_of(loop.tracker);
    tone.amplitude = amplitude;
    tone.amplitude_deviation = deviation;
    return tone;
  };
  const Interval range = Interval::from_bounds(0.98, 1.02);
  const std::size_t narrow = parts_of_range(tone_at, range, 0.29, 0.31, {});
  CHECK(narrow >= 2);  // noise of 0.05 is tolerated at one amplitude
  CHECK(narrow <= 8);
  CHECK(parts_of_range(tone_at, Interval::from_bounds(0.9, 1.1), 0.29, 0.31, {}) > 2 * narrow);
  std::vector<TubeSet> sets;
  const std::vector<AmplitudeRange> parts = equal_parts(range, narrow);
  for (const auto& [low, high] : parts) {
    TrackerModel tracker = loop.model;
    tracker.amplitude = Interval::from_bounds(low, high);
    tracker.amplitude_varies = true;
    SetTask task;
    task.name = "noise";
    task.objective = ShapeObjective::largest_noise;
    task.noise = 0.02;
    sets.push_back(prove_set(tone_at(0.5 * (low + high), 0.5 * (high - low)), tracker, 0.29, 0.31, task));
    REQUIRE(sets.back().is_complete);
  }
  const TubeSet all = join_amplitudes(sets, parts);
  REQUIRE(all.is_complete);
  const TubeAttack attack = attack_tubes(loop.model, all, {60, 500, 2, 1});
  CHECK(attack.starts >= 60);
  CHECK(attack.level_share <= 1.0);
  CHECK(attack.level_share > 0.7);
  // At the amplitudes of another part tubes are left: there is something to lose.
  TubeSet wrong = all;
  wrong.amplitudes.front().low = 1.5;
  wrong.amplitudes.front().high = 1.6;
  CHECK(attack_tubes(loop.model, wrong, {60, 500, 2, 1}).level_share > 1.0);
}

}  // namespace
}  // namespace veritrack::model
