#include "checker/model/gain/detector_loop.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "checker/model/gain/loop_verdicts.hpp"
#include "checker/model/required_claims.hpp"
#include "tests/checker/model/gain/gain_loops.hpp"
#include "tests/support/random.hpp"

namespace veritrack::checker {
namespace {

/// theta' = theta + k (phase - theta): stable for k below 2, bandwidth pi k/(2 - k).
DetectorLoop first_order(double k) {
  return {{{Ball(1.0 - k)}}, {Ball(k)}, {one}};
}

/// theta' = theta + w + kp e, w' = w + ki e, e = phase - theta; w in units of `unit`.
DetectorLoop second_order(double kp, double ki, double unit = 1.0) {
  return {{{Ball(1.0 - kp), Ball(unit)}, {Ball(-ki / unit), one}}, {Ball(kp), Ball(ki / unit)}, {one, zero}};
}

/// pi times the sum of squares of the phase's response, term by term.
double summed(double kp, double ki) {
  double theta = kp, w = ki, sum = 0.0;
  for (int k = 0; k < 40000; ++k) {
    sum += theta * theta;
    const double next = (1.0 - kp) * theta + w;
    w -= ki * theta;
    theta = next;
  }
  return std::numbers::pi * sum;
}

}  // namespace

TEST_CASE("the noise bandwidth is that of the closed form, and of the plain sum") {
  for (const double k : {0.001, 0.1, 1.0, 1.9}) {
    CHECK(noise_bandwidth(first_order(k)).near() ==
          doctest::Approx(std::numbers::pi * k / (2.0 - k)).epsilon(1e-12));
  }
  test::Random random(37032);
  for (std::int64_t trial = 0; trial < test::effort(20); ++trial) {
    const double kp = random.uniform(0.05, 0.6);
    const double ki = random.uniform(0.001, 0.3) * kp;
    const Ball bandwidth = noise_bandwidth(second_order(kp, ki));
    CHECK(bandwidth.near() == doctest::Approx(summed(kp, ki)).epsilon(1e-9));
    CHECK(certainly_less(bandwidth.radius(), Ball(1e-20)));
  }
  // A slow type-2 loop, continuous up to its speed: wn (damping + 1/(4 damping))/2 Hz of 2 pi rad/sample.
  const double wn = 1e-5, damping = 0.7;
  const Ball slow = noise_bandwidth(second_order(2.0 * damping * wn, wn * wn, 1e4));
  CHECK(slow.near() == doctest::Approx(std::numbers::pi * wn * (damping + 0.25 / damping)).epsilon(1e-4));
  CHECK_FALSE(noise_bandwidth(first_order(2.1)).finite());
  CHECK_FALSE(noise_bandwidth(first_order(0.0)).finite());
  CHECK_FALSE(noise_bandwidth(first_order(NAN)).finite());
}

TEST_CASE("the gain at which a loop becomes unstable is that of the closed form") {
  CHECK(is_stable_up_to(first_order(0.1), Ball(19.99)));
  CHECK_FALSE(is_stable_up_to(first_order(0.1), Ball(20.01)));
  CHECK(is_unstable_up_to(first_order(0.1), Ball(20.01)));
  CHECK_FALSE(is_unstable_up_to(first_order(0.1), Ball(19.99)));
  // Jury: f (2 kp - ki) < 4.
  test::Random random(37033);
  for (std::int64_t trial = 0; trial < test::effort(20); ++trial) {
    const double kp = std::pow(10.0, random.uniform(-5.0, -0.3));
    const double ki = random.uniform(0.01, 0.5) * kp * kp;
    const double most = 4.0 / (2.0 * kp - ki);
    const DetectorLoop loop = second_order(kp, ki, 1e3);
    CHECK(is_stable_up_to(loop, Ball((1.0 - 1e-6) * most)));
    CHECK_FALSE(is_stable_up_to(loop, Ball((1.0 + 1e-6) * most)));
    CHECK(is_unstable_up_to(loop, Ball((1.0 + 1e-6) * most)));
    CHECK_FALSE(is_unstable_up_to(loop, Ball((1.0 - 1e-6) * most)));
  }
}

TEST_CASE("a loop that is stable with both gains and not between them is not said to be stable") {
  // (z - 0.9)^3 with the gain 1, (z + 0.9)^3 with the gain 2, and z^3 + 2.43 z in the middle.
  const DetectorLoop loop{{{zero, one, zero}, {zero, zero, one}, {Ball(0.729), Ball(-2.43), Ball(2.7)}},
                          {zero, zero, one},
                          {Ball(1.458), zero, Ball(5.4)}};
  CHECK(is_stable_up_to(loop, Ball(1.0001)));
  CHECK_FALSE(is_stable_up_to(loop, two));
  CHECK_FALSE(is_unstable_up_to(loop, two));
  CHECK(is_unstable_up_to(loop, Ball(1.5)));
}

TEST_CASE("nothing is said of factors below 1, or of what is no number") {
  CHECK_FALSE(is_stable_up_to(first_order(0.1), Ball(0.5)));
  CHECK_FALSE(is_unstable_up_to(first_order(2.1), Ball(0.5)));
  CHECK_FALSE(is_stable_up_to(first_order(NAN), Ball(1.5)));
  CHECK_FALSE(is_unstable_up_to(first_order(NAN), Ball(1.5)));
  CHECK_FALSE(is_stable_up_to(first_order(0.1), Ball(NAN)));
  CHECK_FALSE(is_stable_up_to(first_order(2.1), Ball(1.5)));
}

TEST_CASE("a gain margin is decided of decibels above 0 alone") {
  const GainNetwork motor = test::motor_loop().network();
  const auto verdict = [&](const GainNetwork& network, double decibels) {
    ModelDesign design;
    design.gain_margin = RequiredNumber{"", Ball(decibels)};
    return linear_loop_verdict(kGainMargin, network, design);
  };
  // kp = 0.16 and ki = 2.4/12500: unstable from 4/(2 kp - ki), 21.9 dB.
  CHECK(verdict(motor, 21.9) == Verdict::proved);
  CHECK(verdict(motor, 22.0) == Verdict::refuted);
  CHECK(verdict(motor, 1e-6) == Verdict::proved);
  CHECK(verdict(motor, 0.0) == Verdict::undecided);
  CHECK(verdict(motor, -6.0) == Verdict::undecided);
  // Unstable as it is.
  test::Loop loop = test::motor_loop();
  loop.parameters["kp"] = "30000";
  CHECK(verdict(loop.network(), 1.0) == Verdict::refuted);
  CHECK(verdict(loop.network(), 0.0) == Verdict::undecided);
}

TEST_CASE("the detector of a loop is found from its forms") {
  const auto motor = detector_loop(test::motor_loop().network());
  REQUIRE(motor);
  CHECK(motor->compared[0].near() == doctest::Approx(1.0));
  CHECK(motor->compared[1].near() == doctest::Approx(0.0));
  CHECK(motor->effect[0].near() == doctest::Approx(2000.0 / 12500.0));
  CHECK(motor->effect[1].near() == doctest::Approx(30000.0 / 12500.0));
  // kp = 0.16, ki = 2.4/12500 per sample.
  CHECK(noise_bandwidth(*motor).near() == doctest::Approx(summed(0.16, 2.4 / 12500.0)).epsilon(1e-9));
  const auto output = detector_loop(test::output_loop().network());
  REQUIRE(output);
  CHECK(certainly_positive(noise_bandwidth(*output)));

  GainNetwork other = test::motor_loop().network();
  other.forms.push_back(other.forms[other.angle_forms.at(0)]);
  other.angle_forms.push_back(other.forms.size() - 1);
  CHECK(detector_loop(other));
  other.forms.back().row[1] += Ball(1e-3);
  CHECK_FALSE(detector_loop(other));  // more than one
  other.forms.back().row = {zero, one};
  CHECK(detector_loop(other));  // of the speed alone
  other.forms.back().row = {Ball::hull(-one, one), one};
  CHECK_FALSE(detector_loop(other));
  other.angle_forms.pop_back();
  CHECK(detector_loop(other));  // one that is no angle does not count
  other.angle_forms.clear();
  CHECK_FALSE(detector_loop(other));  // none
}

}  // namespace veritrack::checker
