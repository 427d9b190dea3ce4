// Starts in one known state: simulations of the recursion, written down by hand, are in the set in time.
#include "analysis/model/capture/start_capture.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "analysis/model/set/tube_set.hpp"
#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr double kGain = 1.4;
constexpr double kSpeed = 0.02;

/// An integrator loop whose frequency is not normalised by the amplitude: e = y - alpha; alpha' = alpha + w
/// (k e - beta); beta' = beta + w alpha'; w' = w - g e beta'. States alpha, beta, w. It may start at rest.
test::ExampleTracker plain_integrator_loop() {
  using trackers::Operation;
  test::ExampleTracker example;
  trackers::Recursion& r = example.recursion;
  r.constants = 3;  // k, g, 1/2
  r.states = 3;
  r.samples = 1;
  r.is_angle = {false, false, false};
  trackers::StraightLineProgram step(7);
  const int alpha = 3, beta = 4, w = 5;
  const auto times = [&step](int a, int b) { return step.append(Operation::multiply, a, b); };
  const int e = step.append(Operation::subtract, 6, alpha);
  const int next_alpha =
      step.append(Operation::add, alpha, times(w, step.append(Operation::subtract, times(0, e), beta)));
  const int next_beta = step.append(Operation::add, beta, times(w, next_alpha));
  step.add_result(next_alpha);
  step.add_result(next_beta);
  step.add_result(step.append(Operation::subtract, w, times(times(1, e), next_beta)));
  r.step = step;
  // 2 asin(w/2), of semi-implicit steps.
  r.frequency = trackers::StraightLineProgram(6);
  const int half = r.frequency.append(Operation::asin, r.frequency.append(Operation::multiply, w, 2));
  r.frequency.add_result(r.frequency.append(Operation::add, half, half));
  example.constants = {kGain, kSpeed, 0.5};
  example.start = [](double omega) { return std::vector<double>{1.0, 0.0, 2.0 * std::sin(omega / 2.0)}; };
  return example;
}

/// The loop, and what is certified of it between 0.305 and 0.32 rad/sample with noise.
struct Loop {
  static constexpr double kNoise = 0.01;
  test::Example example{plain_integrator_loop()};
  TubeSet set;
  std::vector<TubeOfLevel> tubes;

  Loop() {
    set = prove_set(
        test::tone_of(example.tracker), example.model, 0.305, 0.32,
        {.name = "assumed", .objective = ShapeObjective::largest_noise, .noise = kNoise, .deviations = {}});
    REQUIRE(set.is_complete);
    for (const ProvedTube& proved : set.tubes) {
      tubes.push_back({&proved.tube, proved.levels.front()});
    }
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;
  Loop(Loop&&) = delete;
  Loop& operator=(Loop&&) = delete;
  ~Loop() = default;

  /// The recursion in long double.
  struct State {
    long double alpha, beta, w;
  };
  static State next(const State& state, long double y) {
    State after = state;
    const long double e = y - state.alpha;
    after.alpha += state.w * (static_cast<long double>(kGain) * e - state.beta);
    after.beta += state.w * after.alpha;
    after.w -= static_cast<long double>(kSpeed) * e * after.beta;
    return after;
  }
  static double error(const State& state, double frequency) {
    return static_cast<double>(2.0L * std::asin(state.w / 2.0L)) - frequency;
  }
  /// Over R_0, in the tube of this frequency.
  [[nodiscard]] double level(const State& state, long double phase, double frequency) const {
    const auto tube = std::find_if(tubes.begin(), tubes.end(), [&](const TubeOfLevel& each) {
      return std::fabs(frequency - each.tube->frequency) <= each.tube->half_width;
    });
    REQUIRE(tube != tubes.end());
    const Eigen::Vector3d x(static_cast<double>(state.alpha), static_cast<double>(state.beta),
                            static_cast<double>(state.w));
    return test::PointTube(*tube->tube).level(x, static_cast<double>(phase), frequency) / tube->level;
  }
};

const Loop& loop() {
  static const Loop made;
  return made;
}

StartQuestion from_rest(double w, double noise, std::size_t most = 400) {
  return {{Interval(0.0), Interval(0.0), Interval(w)}, noise, most};
}

TEST_CASE("a loop that starts at rest is in the set in time, and no simulation is later") {
  const StartQuestion question = from_rest(0.3125, Loop::kNoise);
  const StartCapture found =
      prove_start_captured(loop().example.model, loop().tubes, question, {16, 4, 4000, {}});
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
        CHECK(loop().level(state, here, frequency) <= 1.0 + 1e-9);
      } else {
        latest = loop().level(state, here, frequency) > 1.0 ? std::max(latest, k) : latest;
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

TEST_CASE("at a point the start is followed as exactly as a simulation, and cells contain their points") {
  const TubeOfLevel& target = loop().tubes.front();
  const StartQuestion question = from_rest(0.3125, 0.0);
  test::Random random(7101);
  const TubeCell cell{0.40625, 0.03125, 0.5, 0.25};
  const FollowedStart around = follow_start(loop().example.model, target, cell, question);
  REQUIRE(around.is_captured);
  for (int round = 0; round < 12; ++round) {
    const TubeCell point{cell.turn + cell.half_turn * random.uniform(-1.0, 1.0), 0.0,
                         cell.z + cell.half_z * random.uniform(-1.0, 1.0), 0.0};
    const FollowedStart found = follow_start(loop().example.model, target, point, question);
    REQUIRE(found.is_captured);
    CHECK(found.samples <= around.samples);
    const double frequency = target.tube->frequency + target.tube->half_width * point.z;
    Loop::State state{0.0L, 0.0L, 0.3125L};
    double low = Loop::error(state, frequency);
    double high = low;
    for (std::size_t k = 1; k <= found.samples; ++k) {
      const long double phase =
          2.0L * std::numbers::pi_v<long double> * static_cast<long double>(point.turn) +
          static_cast<long double>(k) * static_cast<long double>(frequency);
      state = Loop::next(state, std::cos(phase));
      low = std::min(low, Loop::error(state, frequency));
      high = std::max(high, Loop::error(state, frequency));
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

TEST_CASE(
    "the same start is captured sooner without noise, and its proof does not depend on the first grid") {
  const auto captured = [](double noise, const VerificationBudget& grid) {
    return prove_start_captured(loop().example.model, {loop().tubes.front()}, from_rest(0.3125, noise), grid);
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
                            std::vector<TubeOfLevel> tubes = loop().tubes) {
    const StartCapture found = prove_start_captured(loop().example.model, tubes, question, grid);
    CHECK(found.samples == 0);
    CHECK(found.cells == 0);
    return found.verdict == Verdict::undecided ? found.reason : std::string();
  };
  // Where the oscillator stands still nothing changes, and it never locks.
  CHECK_FALSE(undecided(from_rest(0.0, 0.0)).empty());
  CHECK(simulated_capture(loop().example.model, loop().tubes, from_rest(0.0, 0.0).state, 400) == 400);
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
    return undecided(from_rest(0.3125, 0.0), {16, 4, 4000, {}}, {{loop().tubes.front().tube, level}});
  };
  CHECK_FALSE(with_level(0.0).empty());
  CHECK_FALSE(with_level(NAN).empty());
  CHECK_FALSE(with_level(1e-12).empty());
  CHECK_FALSE(with_level(INFINITY).empty());
}

TEST_CASE("the guess by simulations is about what is proved") {
  const std::size_t guess =
      simulated_capture(loop().example.model, loop().tubes, from_rest(0.3125, 0.0).state, 1000);
  CHECK(guess > 0);
  CHECK(guess < 200);
}

}  // namespace
}  // namespace veritrack::model
