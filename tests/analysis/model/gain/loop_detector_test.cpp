#include "analysis/model/gain/loop_detector.hpp"

#include <doctest/doctest.h>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/gain_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using test::Detector;

const std::vector<SteadyValue> kSteadyOfLoop{{1, 0.0, 1.0}, {0, 0.0, 1.0}};

LoopNetwork network_for(const test::TwoChannelExample& loop, double amplitude) {
  TrackerModel tracker = loop.model;
  tracker.amplitude = Interval(amplitude);
  return loop_network(tracker, kSteadyOfLoop, Interval::from_bounds(-0.5, 0.5));
}

bool is_near(const Interval& x, double value) {
  return rigor::midpoint(x) == doctest::Approx(value).epsilon(1e-12) && rigor::width(x) < 1e-12;
}

}  // namespace

TEST_CASE("the detector of a loop compares the phase of the samples with a state") {
  const rigor::UpwardRounding upward;
  const double kp = 0.1;
  const double ki = 0.004;
  const double amplitude = 0.5;
  for (const Detector detector : {Detector::arctangent2, Detector::sine}) {
    // A product is proportional to the amplitude.
    const double slope = detector == Detector::sine ? amplitude : 1.0;
    const test::TwoChannelExample loop(test::two_channel_loop(kp, ki, detector));
    const LoopDetector found = detector_of(network_for(loop, amplitude), kSteadyOfLoop);
    REQUIRE(found.loop);
    CHECK(found.objection.empty());
    CHECK(is_near(found.loop->phase[0], 1.0));
    CHECK(is_near(found.loop->phase[1], 0.0));
    CHECK(is_near(found.loop->effect[0], kp * slope));
    CHECK(is_near(found.loop->effect[1], ki * slope));
  }
}

TEST_CASE("a loop that keeps samples has no detector of its phase alone") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.1, 0.004, Detector::sine));
  std::vector<SteadyValue> steady = kSteadyOfLoop;
  CHECK(detector_of(network_for(loop, 1.0), steady).loop);
  steady[0].imaginary = 1;
  CHECK_FALSE(detector_of(network_for(loop, 1.0), steady).loop);
}

TEST_CASE("a loop with other forms of the phase, or with none, has no one detector") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.1, 0.004, Detector::sine));
  LoopNetwork network = network_for(loop, 1.0);
  // Behind the loop filter, of a clamp: the phase, too, and the frequency. It is no angle.
  network.forms.push_back({Interval(-0.004), Interval(1.0)});
  CHECK(detector_of(network, kSteadyOfLoop).loop);
  network.angle_forms.push_back(network.forms.size() - 1);
  CHECK_FALSE(detector_of(network, kSteadyOfLoop).loop);
  CHECK(detector_of(network, kSteadyOfLoop).objection.find("more than one detector") != std::string::npos);
  network.forms.back() = {Interval(-2.0), Interval(0.0)};  // twice the same
  CHECK(detector_of(network, kSteadyOfLoop).loop);
  network.forms.back() = {Interval::from_bounds(-1.0, 1.0), Interval(0.0)};  // perhaps none
  CHECK_FALSE(detector_of(network, kSteadyOfLoop).loop);
  network.forms = {{Interval(0.0), Interval(1.0)}};  // of the frequency alone
  network.angle_forms = {0};
  CHECK_FALSE(detector_of(network, kSteadyOfLoop).loop);
  CHECK(detector_of(network, kSteadyOfLoop).objection.starts_with("nothing in the step"));
}

}  // namespace veritrack::model
