#include "analysis/model/gain/linear_loop.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/gain_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using test::Detector;

LoopNetwork network_of(const test::TwoChannelExample& loop, double amplitude) {
  const rigor::UpwardRounding upward;
  model::TrackerModel tracker = loop.model;
  tracker.amplitude = Interval(amplitude);
  return loop_network(tracker, {{1, 0.0, 1.0}, {0, 0.0, 1.0}}, Interval::from_bounds(-0.5, 0.5));
}

TEST_CASE("the linear loop of a detector: on paper") {
  const double kp = 0.1;
  const double ki = 0.004;
  const double amplitude = 0.5;
  for (const Detector detector : {Detector::arctangent2, Detector::sine}) {
    // atan2 does not see the amplitude, and noise counts by its share of it; a product is proportional to it.
    const bool is_sine = detector == Detector::sine;
    const double slope = is_sine ? amplitude : 1.0;
    const double by_noise = is_sine ? 1.0 : 1.0 / amplitude;
    const test::TwoChannelExample loop(test::two_channel_loop(kp, ki, detector));
    const LoopNetwork network = network_of(loop, amplitude);
    const linear::LinearLoop linear = linear_loop(network);
    CHECK(linear.a(0, 0) == doctest::Approx(1.0 - kp * slope));
    CHECK(linear.a(1, 0) == doctest::Approx(-ki * slope));
    REQUIRE(linear.noise.cols() == 1);
    CHECK(linear.noise(0, 0) == doctest::Approx(kp * by_noise).epsilon(1e-5));
    CHECK(linear.noise(1, 0) == doctest::Approx(ki * by_noise).epsilon(1e-5));
    CHECK(linear.step(0) == -1.0);
    CHECK(linear.step(1) == -1.0);
  }
}

}  // namespace
}  // namespace veritrack::model
