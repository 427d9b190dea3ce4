// A loop and its tube at one frequency, and the same loop in long double, written down by hand.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "analysis/model/capture/capture_track.hpp"
#include "analysis/model/set/tube_set.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::test {

/// The phase-locked loop of example_recursions.hpp about 0.35 rad/sample.
struct CaptureExample {
  static constexpr double kFrequency = 0.35;

  Example loop{phase_locked_loop()};
  model::ProvedTube proved;
  model::CaptureProblem problem;

  explicit CaptureExample(double noise = 0.0) {
    const model::TubeSet set =
        model::prove_set(tone_of(loop.tracker), loop.model, 0.3499, 0.3501,
                         {.name = "starts",
                          .objective = noise > 0.0 ? model::ShapeObjective::largest_noise
                                                   : model::ShapeObjective::largest_starts,
                          .noise = noise,
                          .with_curve = noise == 0.0,
                          .deviations = {}});
    REQUIRE(set.is_complete);
    REQUIRE(set.tubes.size() == 1);
    proved = set.tubes.front();
    problem = {&loop.model, &proved.tube, proved.levels.front(), rigor::Interval(kFrequency), noise};
  }
  CaptureExample(const CaptureExample&) = delete;
  CaptureExample& operator=(const CaptureExample&) = delete;
  CaptureExample(CaptureExample&&) = delete;
  CaptureExample& operator=(CaptureExample&&) = delete;
  ~CaptureExample() = default;

  /// States w and theta, in long double.
  struct State {
    long double w, theta;
  };
  /// On the curve of the tube, plus a deviation.
  [[nodiscard]] State start(double phase, double dw, double dtheta) const {
    const Eigen::VectorXd curve = PointTube(proved.tube).curve(phase, kFrequency);
    return {static_cast<long double>(curve[0]) + static_cast<long double>(dw),
            static_cast<long double>(curve[1]) + static_cast<long double>(dtheta)};
  }
  /// `phase`: after the step, rad; `noise`: of its sample.
  [[nodiscard]] State next(const State& state, long double phase, double noise) const {
    const long double ki = loop.tracker.constants[0];
    const long double kp = loop.tracker.constants[1];
    const long double e = -(std::cos(phase) + static_cast<long double>(noise)) * std::sin(state.theta);
    return {state.w + ki * e, state.theta + state.w + kp * e};
  }
  /// The level in the tube, theta modulo 2 pi.
  [[nodiscard]] double level(const State& state, long double phase) const {
    const double here = static_cast<double>(std::remainder(phase, 2.0L * std::numbers::pi_v<long double>));
    const Eigen::VectorXd curve = PointTube(proved.tube).curve(here, kFrequency);
    const long double turn = 2.0L * std::numbers::pi_v<long double>;
    const long double turns = std::round((state.theta - static_cast<long double>(curve[1])) / turn);
    const Eigen::Vector2d near(static_cast<double>(state.w), static_cast<double>(state.theta - turns * turn));
    return PointTube(proved.tube).level(near, here, kFrequency);
  }
};

}  // namespace veritrack::test
