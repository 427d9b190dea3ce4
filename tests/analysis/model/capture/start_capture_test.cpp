// Starts in one known state: simulations of the recursion, written down by hand, are in the set in time.
#include "analysis/model/capture/start_capture.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "tests/analysis/model/capture/start_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using rigor::Verdict;
using test::from_rest;
using Loop = test::RestingLoop;

TEST_CASE("a loop that starts at rest is in the set in time, and no simulation is later") {
  const StartQuestion question = from_rest(0.3125, Loop::kNoise);
  const StartCapture found = prove_start_captured(test::resting_loop().example.model,
                                                  test::resting_loop().tubes, question, {16, 4, 4000, {}});
  CAPTURE(found.reason);
  REQUIRE(found.verdict == Verdict::proved);
  MESSAGE("in " << found.samples << " samples, in " << found.cells << " cells, errors up to "
                << found.frequency_error.lower() << " and " << found.frequency_error.upper());
  CHECK(found.cells >= 64);
  CHECK(found.samples > 0);
  test::Random random(7100);
  std::size_t latest = 0;
  double largest = 0.0;
  for (std::int64_t round = 0; round < test::effort(300); ++round) {
    const double frequency = random.uniform(0.305, 0.32);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    const bool pushes = random.below(2) == 0;  // noise that pushes the frequency one way
    Loop::State state{0.0L, 0.0L, 0.3125L};
    for (std::size_t k = 1; k <= found.samples + 40; ++k) {
      const long double here = static_cast<long double>(phase) + static_cast<long double>(k) * frequency;
      const bool is_up = pushes ? state.beta < 0.0L : random.below(2) == 0;
      state = Loop::next(state, std::cos(here) + (is_up ? 1.0L : -1.0L) * Loop::kNoise);
      const double error = Loop::error(state, frequency);
      if (k >= found.samples) {
        CHECK(test::resting_loop().level(state, here, frequency) <= 1.0 + 1e-9);
      } else {
        latest = test::resting_loop().level(state, here, frequency) > 1.0 ? std::max(latest, k) : latest;
        // Later than the cell's own last sample, states are in the tube.
        CHECK((found.frequency_error.lower() <= error && error <= found.frequency_error.upper()));
      }
      largest = std::max(largest, std::fabs(error));
    }
  }
  MESSAGE("simulations outside the set until sample " << latest << ", errors up to " << largest);
  CHECK(latest < found.samples);
  CHECK(found.samples < 2 * latest + 40);  // and not much later than these
}

TEST_CASE(
    "the same start is captured sooner without noise, and its proof does not depend on the first grid") {
  const auto captured = [](double noise, const VerificationBudget& grid) {
    return prove_start_captured(test::resting_loop().example.model, {test::resting_loop().tubes.front()},
                                from_rest(0.3125, noise), grid);
  };
  const StartCapture still = captured(0.0, {16, 4, 4000, {}});
  const StartCapture noisy = captured(Loop::kNoise, {16, 4, 4000, {}});
  REQUIRE(still.verdict == Verdict::proved);
  REQUIRE(noisy.verdict == Verdict::proved);
  CHECK(still.samples <= noisy.samples);
  const StartCapture coarse = captured(Loop::kNoise, {4, 1, 4000, {}});
  REQUIRE(coarse.verdict == Verdict::proved);
  CHECK(coarse.cells > 4);
  CHECK(coarse.samples + 40 > noisy.samples);
}

TEST_CASE("a start that is not captured is UNDECIDED, with the reason") {
  const auto undecided = [](const StartQuestion& question, const VerificationBudget& grid = {16, 4, 4000, {}},
                            std::vector<TubeOfLevel> tubes = test::resting_loop().tubes) {
    const StartCapture found =
        prove_start_captured(test::resting_loop().example.model, tubes, question, grid);
    CHECK(found.samples == 0);
    CHECK(found.cells == 0);
    return found.verdict == Verdict::undecided ? found.reason : std::string();
  };
  // Where the oscillator stands still nothing changes, and it never locks.
  CHECK_FALSE(undecided(from_rest(0.0, 0.0)).empty());
  CHECK(simulated_capture(test::resting_loop().example.model, test::resting_loop().tubes,
                          from_rest(0.0, 0.0).state, 400) == 400);
  // Too far away, too soon, too much noise.
  CHECK_FALSE(undecided(from_rest(3.0, 0.0)).empty());
  CHECK_FALSE(undecided(from_rest(0.3125, Loop::kNoise, 4)).empty());
  CHECK_FALSE(undecided(from_rest(0.3125, 10.0)).empty());
  // Nothing follows from nothing.
  CHECK_FALSE(undecided(from_rest(0.3125, 0.0), {16, 4, 4000, {}}, {}).empty());
  CHECK_FALSE(undecided(from_rest(0.3125, 0.0), {0, 4, 4000, {}}).empty());
  CHECK_FALSE(undecided(from_rest(0.3125, 0.0), {16, 3, 4000, {}}).empty());
  CHECK_FALSE(undecided(from_rest(0.3125, 0.0, 0)).empty());
  CHECK_FALSE(undecided(from_rest(0.3125, -0.01)).empty());
  CHECK_FALSE(undecided(from_rest(0.3125, NAN)).empty());
  CHECK_FALSE(undecided({{}, 0.0, 400}).empty());
  CHECK_FALSE(undecided({{Interval(0.0), Interval::empty(), Interval(0.3125)}, 0.0, 400}).empty());
  const auto with_level = [&](double level) {
    return undecided(from_rest(0.3125, 0.0), {16, 4, 4000, {}},
                     {{test::resting_loop().tubes.front().tube, level}});
  };
  CHECK_FALSE(with_level(0.0).empty());
  CHECK_FALSE(with_level(NAN).empty());
  CHECK_FALSE(with_level(1e-12).empty());
  CHECK_FALSE(with_level(INFINITY).empty());
}

TEST_CASE("the guess by simulations is about what is proved") {
  const std::size_t guess = simulated_capture(test::resting_loop().example.model, test::resting_loop().tubes,
                                              from_rest(0.3125, 0.0).state, 1000);
  CHECK(guess > 0);
  CHECK(guess < 200);
}

}  // namespace
}  // namespace veritrack::model
