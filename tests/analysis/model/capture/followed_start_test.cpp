#include "analysis/model/capture/followed_start.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "tests/analysis/model/capture/start_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using test::from_rest;
using LoopAtRest = test::RestingLoop;

TEST_CASE("at a point the start is followed as exactly as a simulation, and cells contain their points") {
  const TubeOfLevel& target = test::resting_loop().tubes.front();
  const StartQuestion question = from_rest(0.3125, 0.0);
  test::Random random(7101);
  const TubeCell cell{0.40625, 0.03125, 0.5, 0.25};
  const FollowedStart around = follow_start(test::resting_loop().example.model, target, cell, question);
  REQUIRE(around.is_captured);
  for (int round = 0; round < 12; ++round) {
    const TubeCell point{cell.turn + cell.half_turn * random.uniform(-1.0, 1.0), 0.0,
                         cell.z + cell.half_z * random.uniform(-1.0, 1.0), 0.0};
    const FollowedStart found = follow_start(test::resting_loop().example.model, target, point, question);
    REQUIRE(found.is_captured);
    CHECK(found.samples <= around.samples);
    const double frequency = target.tube->frequency + target.tube->half_width * point.z;
    LoopAtRest::State state{0.0L, 0.0L, 0.3125L};
    double low = LoopAtRest::error(state, frequency);
    double high = low;
    for (std::size_t k = 1; k <= found.samples; ++k) {
      const long double phase =
          2.0L * std::numbers::pi_v<long double> * static_cast<long double>(point.turn) +
          static_cast<long double>(k) * static_cast<long double>(frequency);
      state = LoopAtRest::next(state, std::cos(phase));
      low = std::min(low, LoopAtRest::error(state, frequency));
      high = std::max(high, LoopAtRest::error(state, frequency));
    }
    constexpr double kRounding = 1e-13;  // of the frequency, which is a double here
    CHECK(found.frequency_error.lower() <= low + kRounding);
    CHECK(found.frequency_error.upper() >= high - kRounding);
    CHECK(found.frequency_error.lower() > low - 1e-8);
    CHECK(found.frequency_error.upper() < high + 1e-8);
    CHECK(around.frequency_error.lower() <= low + kRounding);
    CHECK(around.frequency_error.upper() >= high - kRounding);
  }
}

TEST_CASE("a start that is not captured says what came in between") {
  const TubeOfLevel& target = test::resting_loop().tubes.front();
  const TrackerModel& model = test::resting_loop().example.model;
  const TubeCell point{0.25, 0.0, 0.0, 0.0};
  const FollowedStart soon = follow_start(model, target, point, from_rest(0.3125, 0.0, 4));
  CHECK_FALSE(soon.is_captured);
  CHECK(soon.obstacle == "after 4 samples it is not in the set");
  const FollowedStart wide = follow_start(model, target, {0.5, 0.5, 0.0, 1.0}, from_rest(0.3125, 0.0));
  CHECK_FALSE(wide.is_captured);
  CHECK(wide.obstacle.find("far wider than the set") != std::string::npos);
  StartQuestion short_one = from_rest(0.3125, 0.0);
  short_one.state.pop_back();
  CHECK_THROWS_AS((void)follow_start(model, target, point, short_one), std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::model
