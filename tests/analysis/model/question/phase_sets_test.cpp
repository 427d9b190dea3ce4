#include "analysis/model/question/phase_sets.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/gain_examples.hpp"
#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

constexpr double kLoopLow = 1.0, kLoopHigh = 1.0002;
constexpr double kLoopBandwidth = 0.1;
constexpr double kLoopNoise = 0.01, kLoopStart = 0.002;

SetQuestion loop_question(const test::Example& loop) {
  SetQuestion question{.tone = test::tone_of(loop.tracker), .tracker = loop.model};
  question.whole_band = Interval::from_bounds(kLoopLow, kLoopHigh);
  question.allows_phase_gains = true;
  question.noise = kLoopNoise;
  question.deviations = {Interval(kLoopStart), Interval(0.01)};
  question.assumes_start = true;
  question.largest_noise = true;
  return question;
}

/// Proved once.
const PhaseProof& loop_proof() {
  static const test::Example loop(test::phase_locked_loop(kLoopBandwidth));
  static const PhaseProof proof = [] {
    const rigor::UpwardRounding upward;
    return prove_by_phase_gains(loop_question(loop), {}).value();
  }();
  return proof;
}

/// w' = w + ki e, theta' = theta + w + kp e, e = -y sin theta, in plain numbers.
struct PlainLoop {
  double omega = 0.0, phase = 0.0, w = 0.0, theta = 0.0;

  PlainLoop(double frequency, double begin) : omega(frequency), phase(begin), w(frequency), theta(begin) {
    for (int k = 0; k < 1000; ++k) {
      step(0.0);
    }
  }
  void step(double noise) {
    phase = std::remainder(phase + omega, 2.0 * std::numbers::pi);
    const double e = -(std::cos(phase) + noise) * std::sin(theta);
    theta = std::remainder(theta + w + 4.0 * 0.7071 * kLoopBandwidth * e, 2.0 * std::numbers::pi);
    w += 2.0 * kLoopBandwidth * kLoopBandwidth * e;
  }
  [[nodiscard]] double error() const { return std::fabs(w - omega); }
};

TEST_CASE("without noise the bias and the ripple are those of a settled run") {
  const ProvedSet& starts = loop_proof().starts;
  REQUIRE(starts.is_proved());
  PlainLoop run(kLoopLow, 0.4);
  double low = INFINITY;
  double high = -INFINITY;
  double sum = 0.0;
  constexpr int kRun = 20000;
  for (int k = 0; k < kRun; ++k) {
    run.step(0.0);
    low = std::min(low, run.w - run.omega);
    high = std::max(high, run.w - run.omega);
    sum += run.w - run.omega;
  }
  CHECK(starts.bias.lower() <= sum / kRun + 1e-7);
  CHECK(starts.bias.upper() >= sum / kRun - 1e-7);
  CHECK(rigor::width(starts.bias) < 0.2 * (high - low));
  CHECK(starts.ripple >= high - low);
  CHECK(starts.ripple <= 1.1 * (high - low));
}

TEST_CASE("runs with the assumed noise and starts, and with the largest noise, stay within what is claimed") {
  const PhaseProof& proof = loop_proof();
  REQUIRE(proof.assumed.is_proved());
  CHECK(proof.assumed.start_share == 1.0);
  REQUIRE(proof.noise.has_value());
  CHECK(proof.noise->is_proved());
  CHECK(proof.noise->tubes.noise > kLoopNoise);
  CHECK(proof.noise->frequency_error < proof.noise->half_distance);
  CHECK(proof.starts.reach > kLoopStart);
  test::Random random(940);
  double most = 0.0;
  double reached_late = 0.0;
  for (std::int64_t trial = 0; trial < test::effort(60); ++trial) {
    const auto sign = [&] { return random.below(2) == 0 ? 1.0 : -1.0; };
    PlainLoop run(random.uniform(kLoopLow, kLoopHigh), random.uniform(-3.0, 3.0));
    PlainLoop loud = run;
    PlainLoop far = run;
    run.w += kLoopStart * sign();
    run.theta += 0.01 * sign();
    far.w = far.omega + proof.starts.reach * sign();
    for (int k = 0; k < 400; ++k) {
      const double direction = std::sin(2.0 * run.theta) > 0.0 ? 1.0 : -1.0;
      const double pushed = random.below(4) == 0 ? sign() : direction;
      run.step(kLoopNoise * pushed);
      loud.step(proof.noise->tubes.noise * pushed);
      far.step(0.0);
      most = std::max(most, run.error());
      reached_late = k >= 300 ? std::max(reached_late, run.error()) : reached_late;
      REQUIRE(run.error() <= proof.assumed.frequency_error);
      REQUIRE(loud.error() <= proof.noise->frequency_error);
      REQUIRE(far.error() <= proof.starts.frequency_error);
      const std::size_t block = static_cast<std::size_t>(k) * PhaseKernels::kBlocks / proof.gridding.lags;
      REQUIRE(run.error() <= proof.errors.from_block[std::min(block, PhaseKernels::kBlocks - 1)]);
    }
    REQUIRE(far.error() <= 1.01 * proof.starts.ripple);
  }
  CHECK(most > 0.3 * proof.assumed.frequency_error);
  CHECK(reached_late <= proof.assumed.settled_error);
}

/// What a step may be off; far more than a program.
constexpr double kOffPhase = 1e-5, kOffFrequency = 1e-6, kOffReport = 1e-5;

TEST_CASE("runs that are off in each step stay within what is claimed of a program that rounds") {
  const test::Example loop(test::phase_locked_loop(kLoopBandwidth));
  SetQuestion question = loop_question(loop);
  std::atomic<bool> are_near = true;
  question.rounding = [&](const std::vector<Interval>& states, const Interval& sample) {
    // The states of the loop: w, and theta, whose range is not asked for.
    are_near = are_near && states.size() == 2 && rigor::is_subset(Interval(1.0001), states[0]) &&
               rigor::width(states[0]) < 1.0 && rigor::is_subset(Interval(-1.9), sample);
    return std::vector<double>{kOffFrequency, kOffPhase, kOffReport};
  };
  const rigor::UpwardRounding upward;
  const PhaseProof proof = prove_by_phase_gains(question, {}).value();
  CHECK(are_near);
  REQUIRE(proof.room.size() == 2);
  CHECK(proof.room[0] < 1.0);
  CHECK(proof.room[1] == INFINITY);
  CHECK(proof.starts.ripple > loop_proof().starts.ripple + kOffReport);
  CHECK(proof.assumed.frequency_error > loop_proof().assumed.frequency_error + kOffReport);
  test::Random random(941);
  double most = 0.0;
  for (std::int64_t trial = 0; trial < test::effort(60); ++trial) {
    PlainLoop run(random.uniform(kLoopLow, kLoopHigh), random.uniform(-3.0, 3.0));
    double low = INFINITY;
    double high = -INFINITY;
    const double sign = random.below(2) == 0 ? 1.0 : -1.0;
    for (int k = 0; k < 400; ++k) {
      run.step(0.0);
      run.w += sign * kOffFrequency;
      run.theta += sign * kOffPhase;
      const double error = run.w - run.omega;
      most = std::max(most, std::fabs(error) + kOffReport);
      low = k >= 300 ? std::min(low, error) : low;
      high = k >= 300 ? std::max(high, error) : high;
    }
    REQUIRE(high - low + 2.0 * kOffReport <= proof.starts.ripple);
    REQUIRE(high + kOffReport <= proof.starts.settled_error);
    REQUIRE(low - kOffReport >= -proof.starts.settled_error);
  }
  CHECK(most > 0.3 * proof.starts.settled_error);
  question.rounding = [](const auto&, const auto&) -> std::vector<double> {
    throw NoRounding("no bound for this");
  };
  const PhaseProof exact = prove_by_phase_gains(question, {}).value();
  CHECK(exact.room.empty());
  CHECK(exact.no_rounding == "no bound for this");
}

TEST_CASE("the first block from which the error is certainly below a target, in samples") {
  const rigor::UpwardRounding upward;
  PhaseProof proof;
  proof.gridding.lags = 10 * PhaseKernels::kBlocks;
  proof.errors.from_block = {4.0, 2.0, 1.0, 0.5};
  CHECK(samples_below(proof, Interval(5.0)) == 0.0);
  CHECK(samples_below(proof, Interval(4.0)) == 10.0);
  CHECK(samples_below(proof, Interval::from_bounds(1.0, 3.0)) == 30.0);
  CHECK(samples_below(proof, Interval(0.75)) == 30.0);
  CHECK(samples_below(proof, Interval(0.5)) == INFINITY);
  proof.errors.from_block = {NAN, 1.0};
  CHECK(samples_below(proof, Interval(2.0)) == 10.0);
}

TEST_CASE("what is known already is not searched for, and too much noise is a reason" *
          doctest::test_suite("nightly")) {
  const test::TwoChannelExample loop(test::angle_loop(0.04, 0.4));
  const rigor::UpwardRounding upward;
  SetQuestion question{.tone = loop.tone, .tracker = loop.model};
  question.whole_band = Interval::from_bounds(kLoopLow, kLoopHigh);
  question.allows_phase_gains = question.assumes_start = question.largest_noise = true;
  question.deviations = {Interval(0.0), Interval(0.0)};
  question.noise = 1.5;  // more than the signal
  const auto proof = prove_by_phase_gains(question, {10.0, 10.0});
  REQUIRE(proof.has_value());
  CHECK(proof->starts.is_proved());
  CHECK_FALSE(proof->noise.has_value());
  CHECK(proof->starts.reach == 0.0);
  CHECK_FALSE(proof->assumed.is_proved());
  CHECK(proof->assumed.tubes.reasons.size() == 1);
  CHECK(proof->assumed.start_share == INFINITY);
  CHECK(proof->assumed.frequency_error == INFINITY);
  question.largest_noise = false;
  NoGains reason;
  CHECK_FALSE(prove_by_phase_gains(question, {}, &reason).has_value());
  CHECK(reason.kind == NoGains::Kind::bounds);
}

TEST_CASE("questions and loops that this proof does not cover have their reasons") {
  const rigor::UpwardRounding upward;
  const test::Example loop(test::phase_locked_loop(kLoopBandwidth));
  SetQuestion question = loop_question(loop);
  NoGains reason{NoGains::Kind::bounds, "before"};
  const auto kind_over = [&](double low, double high) {
    question.whole_band = Interval::from_bounds(low, high);
    CHECK_FALSE(prove_by_phase_gains(question, {}, &reason).has_value());
    return reason.kind;
  };
  CHECK(kind_over(0.0, 0.1) == NoGains::Kind::band);
  CHECK(kind_over(3.0, std::numbers::pi) == NoGains::Kind::band);
  question.allows_phase_gains = false;
  CHECK(kind_over(1.0, 1.0002) == NoGains::Kind::question);
  CHECK(reason.detail.empty());
  CHECK_FALSE(prove_by_phase_gains(question, {}).has_value());  // without a place for the reason
  const test::Example unstable(test::phase_locked_loop(2.0));
  question.allows_phase_gains = true;
  question.tone = test::tone_of(unstable.tracker);
  question.tracker = unstable.model;
  CHECK(kind_over(1.0, 1.0002) == NoGains::Kind::structure);
  CHECK(reason.detail.find("no basis") != std::string::npos);
}

}  // namespace
}  // namespace veritrack::model
