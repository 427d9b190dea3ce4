#include "analysis/model/question/gain_sets.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/model/gain/linear_loop.hpp"
#include "analysis/model/tube/tube_proposal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/gain_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;
using test::Detector;

SetQuestion question_of(const test::TwoChannelExample& loop) {
  SetQuestion question{.tone = loop.tone, .tracker = loop.model};
  question.whole_band = Interval::from_bounds(-0.5, 0.5);
  question.allows_gains = true;
  question.noise = 0.05;
  question.largest_noise = true;
  question.largest_slew = true;
  question.is_thorough = true;
  return question;
}

TEST_CASE("a loop of two channels is answered over a band through 0, with the noise of its gain") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::sine));
  const auto sets = prove_by_gains(question_of(loop));
  REQUIRE(sets.has_value());
  REQUIRE(sets->gains.has_value());
  REQUIRE(sets->assumed.has_value());
  CHECK(sets->assumed->is_proved());
  REQUIRE(sets->noise.has_value());
  CHECK(sets->noise->tubes.noise > 0.6);
  CHECK(sets->noise->tubes.noise < 0.62);
  REQUIRE(sets->slew.has_value());
  CHECK(sets->slew->tubes.slew > 0.0);
  CHECK(sets->starts.reach > 0.0);
  CHECK(sets->starts.ripple < 1e-9);
  REQUIRE(sets->linear.has_value());
  CHECK(sets->assumed->settled_error <= 1.01 * sets->linear->disturbed);
  CHECK(samples_below(*sets->gains, Interval(sets->assumed->settled_error * 1.01)) == 0.0);
  CHECK(std::isinf(samples_below(*sets->gains, Interval(sets->assumed->settled_error * 0.5))));
}

TEST_CASE("assumed starts: inside, or the share of them that is") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::sine));
  SetQuestion question = question_of(loop);
  question.assumes_start = true;
  question.deviations = {Interval(0.3), Interval(0.001)};
  const auto near = prove_by_gains(question);
  REQUIRE(near.has_value());
  CHECK(near->assumed->start_share <= 1.0);
  CHECK(near->assumed->frequency_error > near->assumed->settled_error);
  CHECK(samples_below(*near->gains, Interval(near->assumed->settled_error * 1.1)) > 0.0);
  question.deviations = {Interval(30.0), Interval(0.1)};
  const auto far = prove_by_gains(question);
  REQUIRE(far.has_value());
  CHECK(far->assumed->start_share > 1.0);
  CHECK(far->assumed->is_proved());
}

TEST_CASE("too much noise is not proved, and what is tolerated is") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::sine));
  SetQuestion question = question_of(loop);
  question.noise = 0.9;
  const auto sets = prove_by_gains(question);
  REQUIRE(sets.has_value());
  CHECK_FALSE(sets->assumed->is_proved());
  CHECK_FALSE(sets->assumed->tubes.reasons.empty());
  CHECK(sets->noise->tubes.noise > 0.6);
}

TEST_CASE("an assumed noise or slew that is proved is tolerated, however near to the largest one") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::sine));
  SetQuestion question = question_of(loop);
  const double found = prove_by_gains(question)->noise->tubes.noise;
  question.noise = 1.0005 * found;
  const auto near = prove_by_gains(question);
  REQUIRE(near->assumed->is_proved());
  CHECK(near->noise->tubes.noise == question.noise);
  CHECK(near->noise->is_proved());
  question.noise = 1.1 * found;
  CHECK(prove_by_gains(question)->noise->tubes.noise == found);
}

TEST_CASE("the deadline ends the searches for largest values, and what is assumed is proved") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::sine));
  SetQuestion question = question_of(loop);
  question.deadline = search::Deadline(0.0);
  const auto sets = prove_by_gains(question);
  REQUIRE(sets.has_value());
  CHECK(sets->assumed->is_proved());
  CHECK(sets->starts.is_proved());
  CHECK(sets->starts.reach == 0.0);
  REQUIRE(sets->noise.has_value());
  CHECK(sets->noise->is_proved());
  CHECK(sets->noise->tubes.noise == question.noise);  // at least the assumed one
  REQUIRE(sets->slew.has_value());
  CHECK_FALSE(sets->slew->is_proved());
  CHECK(sets->slew->tubes.reasons == std::vector<std::string>{kTimeLimit});
}

TEST_CASE("an unstable loop is known as such") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(2.1, 0.03, Detector::arctangent2));
  const auto sets = prove_by_gains(question_of(loop));
  REQUIRE(sets.has_value());
  REQUIRE(sets->gains.has_value());
  REQUIRE(sets->gains->radius.has_value());
  CHECK(sets->gains->radius->lower > 1.05);
  CHECK_FALSE(sets->gains->gains.has_value());
  CHECK_FALSE(sets->starts.is_proved());
}

TEST_CASE("a start near an unstable steady state finds the stable one, half a turn away or by simulation") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::sine));
  for (const double off : {2.5, 3.1, 1.6, -2.0}) {
    SetQuestion question = question_of(loop);
    question.tone.start = [off](double omega) { return std::vector<double>{omega + off, omega}; };
    const auto sets = prove_by_gains(question);
    REQUIRE(sets.has_value());
    REQUIRE(sets->gains->radius.has_value());
    CHECK(sets->gains->radius->upper < 1.0);
    CHECK(std::fabs(std::remainder(sets->gains->steady[0].constant, 2.0 * std::acos(-1.0))) < 1e-9);
    CHECK(sets->assumed->is_proved());
  }
}

TEST_CASE("two states of which the direction alone matters are one angle, unless a start is off in them") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::turn_between_samples(0.2));
  SetQuestion question = question_of(loop);
  const auto sets = prove_by_gains(question);
  REQUIRE(sets.has_value());
  CHECK(sets->gains->steady[0].imaginary == 1);
  CHECK(sets->assumed->is_proved());
  CHECK(sets->noise->tubes.noise > 0.8);  // two angles of noise and 1 rad/sample are below half a turn
  question.assumes_start = true;
  question.deviations = {Interval(0.0), Interval(0.0), Interval(0.1)};
  CHECK(prove_by_gains(question).has_value());
  question.deviations = {Interval(0.0), Interval(0.01), Interval(0.0)};
  CHECK_FALSE(prove_by_gains(question).has_value());
}

TEST_CASE("other questions are left to tubes") {
  const rigor::UpwardRounding upward;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::sine));
  SetQuestion question = question_of(loop);
  question.allows_gains = false;
  NoGains reason{NoGains::Kind::bounds};
  CHECK_FALSE(prove_by_gains(question, &reason).has_value());
  CHECK(reason.kind == NoGains::Kind::question);
  question.allows_gains = true;
  question.whole_band = Interval::from_bounds(0.0, 4.0);
  CHECK_FALSE(prove_by_gains(question, &reason).has_value());
  CHECK(reason.kind == NoGains::Kind::band);
}

TEST_CASE("a fast loop of one channel is far from its linear recursion, a slow one is near") {
  const rigor::UpwardRounding upward;
  for (const auto& [bandwidth, is_near] : {std::pair(0.02, false), std::pair(0.0002, true)}) {
    const test::Example loop(test::phase_locked_loop(bandwidth));
    SetQuestion question{.tone = test::tone_of(loop.tracker), .tracker = loop.model};
    question.whole_band = Interval::from_bounds(0.2, 0.3);
    question.allows_gains = true;
    question.noise = 0.03;
    const auto sets = prove_by_gains(question);
    REQUIRE(sets.has_value());
    CHECK(sets->assumed->is_proved());
    CHECK_FALSE(sets->gains->radius.has_value());
    CHECK(is_near_linear(*sets) == is_near);
    CHECK(sets->starts.ripple > 0.0);
    question.whole_band = Interval::from_bounds(-0.3, 0.3);
    CHECK_FALSE(prove_by_gains(question).has_value());
  }
}

/// w of a loop with this detector on a tone of amplitude 1, whose samples are turned and noisy in the way
/// that pushes its angle most.
double pushed_error(double kp, double ki, double omega, double turned, double noise, int samples) {
  double theta = omega;
  double w = omega;
  double phase = 0.0;
  double most = 0.0;
  for (int k = 0; k < samples; ++k) {
    phase = std::remainder(phase + omega, 2.0 * std::numbers::pi);
    const double sign = k % (samples / 4) < samples / 8 ? 1.0 : -1.0;
    const double angle = phase - theta;
    // The noise along the imaginary axis of the loop, then the turn.
    const double real = std::cos(angle);
    const double imaginary = std::sin(angle) + sign * noise;
    const double e = std::atan2(imaginary, real) + sign * turned;
    theta = std::remainder(theta + w + kp * e, 2.0 * std::numbers::pi);
    w += ki * e;
    most = std::max(most, std::fabs(w - omega));
  }
  return most;
}

TEST_CASE("an angle of the samples that a program has with an error counts as noise") {
  constexpr double kTurned = 0.04;
  const test::TwoChannelExample loop(test::two_channel_loop(0.05, 0.001, Detector::arctangent2));
  SetQuestion question = question_of(loop);
  question.rounding = [](const auto&, const auto&) { return std::vector<double>(3, 0.0); };
  question.turned = kTurned;
  const auto [turned, plain] = [&] {
    const rigor::UpwardRounding upward;
    const std::optional<ProvedSets> with = prove_by_gains(question);
    question.turned = 0.0;
    question.noise += kTurned * (1.0 + question.noise);
    return std::pair(with, prove_by_gains(question));
  }();
  REQUIRE(turned.has_value());
  REQUIRE(plain.has_value());
  CHECK(turned->no_rounding == "");
  // The loop to first order is that of an exact arc tangent.
  CHECK(linear_loop(turned->gains->gains->network()).noise.norm() ==
        doctest::Approx(linear_loop(plain->gains->gains->network()).noise.norm()));
  CHECK(turned->assumed->frequency_error == doctest::Approx(plain->assumed->frequency_error).epsilon(1e-9));
  CHECK(turned->assumed->settled_error == doctest::Approx(plain->assumed->settled_error).epsilon(1e-9));
  CHECK(turned->starts.settled_error > 0.3 * turned->assumed->settled_error);  // without noise, too
  const double noise = turned->noise->tubes.noise;
  CHECK(noise + kTurned * (1.0 + noise) <= 1.001 * plain->noise->tubes.noise);
  CHECK(noise + kTurned * (1.0 + noise) > 0.98 * plain->noise->tubes.noise);
  const double still = pushed_error(0.05, 0.001, 0.3, kTurned, 0.0, 4000);
  const double noisy = pushed_error(0.05, 0.001, 0.3, kTurned, 0.05, 4000);
  CHECK(still <= turned->starts.frequency_error);
  CHECK(still > 0.6 * turned->starts.settled_error);
  CHECK(noisy <= turned->assumed->frequency_error);
  CHECK(noisy > 0.6 * turned->assumed->settled_error);
}

}  // namespace
}  // namespace veritrack::model
