// A loop that starts at rest, what is certified of it, and the same loop in long double, written down by
// hand.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "analysis/model/capture/followed_start.hpp"
#include "analysis/model/set/tube_set.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::test {

inline constexpr double kGainOfLoop = 1.4;
inline constexpr double kSpeedOfLoop = 0.02;

/// An integrator loop whose frequency is not normalised by the amplitude: e = y - alpha; alpha' = alpha + w
/// (k e - beta); beta' = beta + w alpha'; w' = w - g e beta'. States alpha, beta, w. It may start at rest.
inline ExampleTracker plain_integrator_loop() {
  using trackers::Operation;
  ExampleTracker example;
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
  example.constants = {kGainOfLoop, kSpeedOfLoop, 0.5};
  example.start = [](double omega) { return std::vector<double>{1.0, 0.0, 2.0 * std::sin(omega / 2.0)}; };
  return example;
}

/// The loop, and what is certified of it between 0.305 and 0.32 rad/sample with noise.
struct RestingLoop {
  static constexpr double kNoise = 0.01;
  Example example{plain_integrator_loop()};
  model::TubeSet set;
  std::vector<model::TubeOfLevel> tubes;

  RestingLoop() {
    set = prove_set(tone_of(example.tracker), example.model, 0.305, 0.32,
                    {.name = "assumed",
                     .objective = model::ShapeObjective::largest_noise,
                     .noise = kNoise,
                     .deviations = {}});
    REQUIRE(set.is_complete);
    for (const model::ProvedTube& proved : set.tubes) {
      tubes.push_back({&proved.tube, proved.levels.front()});
    }
  }
  RestingLoop(const RestingLoop&) = delete;
  RestingLoop& operator=(const RestingLoop&) = delete;
  RestingLoop(RestingLoop&&) = delete;
  RestingLoop& operator=(RestingLoop&&) = delete;
  ~RestingLoop() = default;

  /// The recursion in long double.
  struct State {
    long double alpha, beta, w;
  };
  static State next(const State& state, long double y) {
    State after = state;
    const long double e = y - state.alpha;
    after.alpha += state.w * (static_cast<long double>(kGainOfLoop) * e - state.beta);
    after.beta += state.w * after.alpha;
    after.w -= static_cast<long double>(kSpeedOfLoop) * e * after.beta;
    return after;
  }
  static double error(const State& state, double frequency) {
    return static_cast<double>(2.0L * std::asin(state.w / 2.0L)) - frequency;
  }
  /// Over R_0, in the tube of this frequency.
  [[nodiscard]] double level(const State& state, long double phase, double frequency) const {
    const auto tube = std::find_if(tubes.begin(), tubes.end(), [&](const model::TubeOfLevel& each) {
      return std::fabs(frequency - each.tube->frequency) <= each.tube->half_width;
    });
    REQUIRE(tube != tubes.end());
    const Eigen::Vector3d x(static_cast<double>(state.alpha), static_cast<double>(state.beta),
                            static_cast<double>(state.w));
    return PointTube(*tube->tube).level(x, static_cast<double>(phase), frequency) / tube->level;
  }
};

inline const RestingLoop& resting_loop() {
  static const RestingLoop made;
  return made;
}

inline model::StartQuestion from_rest(double w, double noise, std::size_t most = 400) {
  return {{rigor::Interval(0.0), rigor::Interval(0.0), rigor::Interval(w)}, noise, most};
}

}  // namespace veritrack::test
