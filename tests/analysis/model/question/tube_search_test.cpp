#include "analysis/model/question/tube_search.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using rigor::Verdict;

const SearchedBand kNarrowBand{0.3, 0.3002, {}};

SetTask noise_task(double noise, double slew = 0.0) {
  return {.name = "assumed",
          .objective = ShapeObjective::largest_noise,
          .noise = noise,
          .slew = slew,
          .deviations = {}};
}

TEST_CASE("a task with a slew gets tubes for a frequency that moves, and others for a constant one") {
  const test::Example loop(test::phase_locked_loop());
  const TubeSearch search(test::tone_of(loop.tracker), loop.model, kNarrowBand, {});
  double share = 0.0;
  const auto tell = [&](double done) { share = done; };
  const TubeSet constant = search.prove(noise_task(0.01), tell);
  REQUIRE(constant.is_complete);
  CHECK(share == 1.0);
  CHECK(constant.slew == 0.0);
  CHECK(constant.crossing.empty());
  const TubeSet moving = search.prove(noise_task(0.01, 1e-6), tell);
  REQUIRE(moving.is_complete);
  CHECK(moving.slew == 1e-6);
  CHECK_FALSE(moving.crossing.empty());
  CHECK_FALSE(search.prove_long_run(constant).has_value());  // the loop is no filter
}

TEST_CASE("with a part of the band out of reach no set is complete, and the reason comes first") {
  const test::Example loop(test::phase_locked_loop());
  SearchedBand band = kNarrowBand;
  band.out_of_reach = {"out of reach above 0.3002 rad/sample"};
  const TubeSet set =
      TubeSearch(test::tone_of(loop.tracker), loop.model, band, {}).prove(noise_task(0.01), [](double) {});
  CHECK_FALSE(set.is_complete);
  CHECK_FALSE(set.tubes.empty());
  REQUIRE(set.reasons.size() == 1);
  CHECK(set.reasons.front() == band.out_of_reach.front());
}

TEST_CASE("a constant amplitude in a range: tubes for each part, on the amplitudes of the part") {
  const test::Example loop(test::phase_locked_loop());
  TrackerModel tracker = loop.model;
  tracker.amplitude = Interval::from_bounds(0.991, 1.009);
  tracker.amplitude_varies = true;
  const auto tone_at = [&](double amplitude, double deviation) {
    TrackedTone tone = test::tone_of(loop.tracker);
    tone.amplitude = amplitude;
    tone.amplitude_deviation = deviation;
    return tone;
  };
  const TubeSearch search(tone_at, tracker, kNarrowBand, {});
  std::vector<double> shares;
  const TubeSet set = search.prove(noise_task(0.01), [&](double share) { shares.push_back(share); });
  REQUIRE(set.is_complete);
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.back() == 1.0);
  REQUIRE(set.amplitudes.size() > 1);
  CHECK(set.amplitudes.front().low <= 0.991);
  CHECK(set.amplitudes.back().high >= 1.009);
  for (const TubeSet& part : sets_of_amplitudes(set)) {
    const ProvedTube& proved = part.tubes.front();
    const TrackerModel on_part = on_amplitudes_of(tracker, part);
    const LevelQuestion question{proved.levels.front(), set.noise, 1.0, proved.shrinking.front()};
    CHECK(verify_level(on_part, proved.tube, question, proved.grid).verdict == Verdict::proved);
    CHECK(proved.tube.amplitude > part.amplitudes.front().low);
    CHECK(proved.tube.amplitude < part.amplitudes.front().high);
  }
  // To first order: the largest of the parts' middles, none of which varies.
  const auto linear = search.linear_over(set);
  REQUIRE(linear.has_value());
  double largest = 0.0;
  for (const AmplitudePart& part : set.amplitudes) {
    for (int i = 0; i < 5; ++i) {
      const double frequency = set.part.low + 0.25 * i * (set.part.high - set.part.low);
      const auto here = linear_worst_case(tone_at(part.low + 0.5 * (part.high - part.low), 0.0), frequency,
                                          set.noise, set.slew);
      largest = std::max(largest, here.value().disturbed);
    }
  }
  CHECK(linear->disturbed == largest);
}

}  // namespace
}  // namespace veritrack::model
