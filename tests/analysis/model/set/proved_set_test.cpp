#include "analysis/model/set/proved_set.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "trackers/model/model_tracker.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

constexpr double kRipple = 0.0625;
constexpr double kSize = 0.5;

/// A tracker whose one state is the frequency. About omega there are tubes omega + offset + ripple cos(phi) +
/// size xi: the error is offset + ripple cos(phi) + size xi.
struct FrequencyState {
  trackers::Recursion recursion;
  trackers::StraightLineProgram signal{2};
  TrackerModel model;

  FrequencyState() {
    recursion.states = 1;
    recursion.samples = 1;
    recursion.is_angle = {false};
    recursion.step = trackers::StraightLineProgram(2);
    recursion.step.add_result(0);
    recursion.frequency = trackers::StraightLineProgram(1);
    recursion.frequency.add_result(0);
    signal.add_result(0);
    model.recursion = &recursion;
    model.signal = &signal;
    model.amplitude = Interval(1.0);
  }
  FrequencyState(const FrequencyState&) = delete;
  FrequencyState& operator=(const FrequencyState&) = delete;
  FrequencyState(FrequencyState&&) = delete;
  FrequencyState& operator=(FrequencyState&&) = delete;
  ~FrequencyState() = default;
};

ProvedTube tube_with_offset(double frequency, double offset) {
  constexpr double kHalfWidth = 0.125;
  ProvedTube proved;
  proved.tube.frequency = frequency;
  proved.tube.half_width = kHalfWidth;
  proved.tube.turns = {0};
  proved.tube.curve = {{{{frequency + offset, kHalfWidth}, {kRipple}}}};
  proved.tube.shape = {{{{kSize}}}};
  proved.levels = {1.0, 0.5, 0.0625};
  proved.shrinking = {0.99, 0.9};
  return proved;
}

/// Two tubes, of which nothing is proved.
TubeSet two_tubes() {
  TubeSet set;
  set.tubes = {tube_with_offset(1.0, 0.0), tube_with_offset(1.25, 0.03125)};
  set.crossing = {0.995, 0.95};
  set.is_complete = true;
  set.part = {0.875, 1.375};
  return set;
}

/// At least a bound, and at most a little more than a thousandth above it.
void check_bound(double bound, double exact) {
  CHECK(bound >= exact);
  CHECK(bound <= 1.0011 * exact + 2e-4);
}

TEST_CASE("of several tubes that is concluded which holds for each") {
  const FrequencyState tracker;
  std::vector<FrequencySlice> slices;
  const ProvedSet set = conclude(tracker.model, two_tubes(), {Interval(0.25)}, &slices);
  const rigor::UpwardRounding upward;
  check_bound(set.frequency_error, 0.03125 + kRipple + kSize);
  check_bound(set.settled_error, 0.03125 + kRipple + kSize / 16.0);
  check_bound(set.start_share, 0.25 / kSize);
  // What is unknown of the mean gives the ripple some room, too.
  CHECK(set.ripple >= 2.0 * kRipple + 2.0 * kSize / 16.0);
  CHECK(set.ripple <= 1.01 * (2.0 * kRipple + 2.0 * kSize / 16.0) + 2e-4);
  // Downwards the second tube reaches to offset + ripple - size.
  CHECK(set.reach <= kSize - kRipple - 0.03125);
  CHECK(set.reach >= 0.998 * (kSize - kRipple - 0.03125));
  // The mean of the error is within size/16 of the offsets.
  CHECK(set.bias.lower() <= -kSize / 16.0);
  CHECK(set.bias.lower() >= -1.2 * kSize / 16.0);
  CHECK(set.bias.upper() >= 0.03125 + kSize / 16.0);
  CHECK(set.bias.upper() <= 0.03125 + 1.2 * kSize / 16.0);
  CHECK(set.is_proved());
  CHECK_FALSE(set.has_part());
  REQUIRE_FALSE(slices.empty());
  CHECK(slices.front().low == 0.875);
  CHECK(slices.back().high == 1.375);
  for (std::size_t i = 0; i < slices.size(); ++i) {
    CHECK((i == 0 || slices[i].low == slices[i - 1].high));
    const double offset = slices[i].high <= 1.125 ? 0.0 : 0.03125;
    CHECK(slices[i].bias.lower() <= offset - kSize / 16.0);
    CHECK(slices[i].bias.upper() >= offset + kSize / 16.0);
    CHECK(slices[i].reach >= set.reach);
    CHECK(slices[i].reach <= kSize - kRipple - offset);
  }
}

TEST_CASE("where one tube has no known frequency, nothing is known of the set") {
  FrequencyState tracker;
  // The frequency is sqrt(state), which is undefined where the second tube reaches below 0.
  tracker.recursion.frequency = trackers::StraightLineProgram(1);
  tracker.recursion.frequency.add_result(tracker.recursion.frequency.append(trackers::Operation::sqrt, 0));
  for (const bool is_first : {true, false}) {
    TubeSet tubes = two_tubes();
    ProvedTube& wide = is_first ? tubes.tubes.front() : tubes.tubes.back();
    wide.levels = {8.0, 4.0};
    const ProvedSet set = conclude(tracker.model, tubes, {Interval(0.25)});
    CHECK(set.frequency_error == INFINITY);
    CHECK(set.settled_error == INFINITY);
    CHECK(set.ripple == INFINITY);
    CHECK_FALSE(rigor::is_finite(set.bias));
    CHECK(set.reach == 0.0);
  }
  const ProvedSet none = conclude(tracker.model, {}, {Interval(0.25)});
  CHECK(none.frequency_error == INFINITY);
  CHECK(none.start_share == INFINITY);
  CHECK(none.reach == 0.0);
  CHECK_FALSE(none.is_proved());
}

TEST_CASE("with parts of the amplitudes that is concluded which holds for each of them") {
  const FrequencyState tracker;
  TubeSet parts;
  parts.tubes = {tube_with_offset(1.0, 0.0), tube_with_offset(1.0, -0.03125)};
  parts.tubes.back().levels = {0.75, 0.5, 0.125};
  parts.is_complete = true;
  parts.part = {0.875, 1.125};
  parts.amplitudes = {{0.5, 1.0, 0, 1}, {1.0, 1.5, 1, 2}};
  std::vector<FrequencySlice> slices;
  const ProvedSet set = conclude(tracker.model, parts, {Interval(0.25)}, &slices);
  check_bound(set.frequency_error, kRipple + kSize);
  check_bound(set.settled_error, 0.03125 + kRipple + kSize / 8.0);
  check_bound(set.start_share, 0.25 / kSize / 0.75);
  CHECK(set.tubes.tubes.size() == 2);
  // One list over the band, with what both parts have.
  REQUIRE_FALSE(slices.empty());
  CHECK(slices.front().low == 0.875);
  CHECK(slices.back().high == 1.125);
  for (const FrequencySlice& slice : slices) {
    CHECK(slice.bias.lower() <= -0.03125 - kSize / 8.0);
    CHECK(slice.bias.upper() >= kSize / 16.0);
    CHECK(slice.reach <= 0.75 * kSize - kRipple - 0.03125);
  }
}

TEST_CASE("a set begun at a lower level keeps the factors of the pairs that are left") {
  TubeSet set = two_tubes();
  set.amplitudes = {{0.5, 1.5, 0, 2, {0.97, 0.96}, 0.0}};
  const TubeSet lower = from_level(set, 1);
  for (const ProvedTube& tube : lower.tubes) {
    CHECK(tube.levels == std::vector{0.5, 0.0625});
    CHECK(tube.shrinking == std::vector{0.9});
  }
  CHECK(lower.crossing == std::vector{0.95});
  CHECK(lower.amplitudes.front().crossing == std::vector{0.96});
  // A single level shrinks by what the last pair does.
  const TubeSet lowest = from_level(set, 2);
  CHECK(lowest.tubes.front().levels == std::vector{0.0625});
  CHECK(lowest.tubes.front().shrinking == std::vector{0.9});
  CHECK(from_level(set, 0).tubes.front().levels == set.tubes.front().levels);
  CHECK(from_level(set, 0).tubes.front().shrinking == set.tubes.front().shrinking);
}

TEST_CASE("a requirement is met at the first level that does, if starts are inside it") {
  const FrequencyState tracker;
  const auto first_level = [&](double start, double required) {
    const std::vector<Interval> starts{Interval(start)};
    const ProvedSet set = conclude(tracker.model, two_tubes(), starts);
    return lowered_to(tracker.model, set, starts, Interval(required)).tubes.tubes.front().levels.front();
  };
  // The error at the levels is 0.594, 0.344 and 0.125; starts of 0.03 have a level of 0.06.
  CHECK(first_level(0.03, 1.0) == 1.0);
  CHECK(first_level(0.03, 0.4) == 0.5);
  CHECK(first_level(0.03, 0.2) == 0.0625);
  CHECK(first_level(0.03, 0.1) == 1.0);
  CHECK(first_level(0.2, 0.4) == 0.5);
  CHECK(first_level(0.2, 0.2) == 1.0);
  CHECK(first_level(0.3, 0.4) == 1.0);
}

}  // namespace
}  // namespace veritrack::model
