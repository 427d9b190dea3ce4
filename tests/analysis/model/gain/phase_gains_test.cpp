// Bounds that are resolved over the phases, attacked: the noise that pushes in the direction of the linear
// response at every sample, and random noise, from the steady state.
#include "analysis/model/gain/phase_gains.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "analysis/model/gain/floquet_proposal.hpp"
#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack {

namespace {

constexpr double kLow = 0.29, kHigh = 0.31;
constexpr auto kGauge = model::FloquetGauge::by_mode;

/// Of part number `part` at a constant frequency, or of all parts with a slew.
std::optional<model::PhaseGains> gains_of(const model::TrackerModel& tracker, const model::FloquetCell& cell,
                                          const model::PhaseGridding& gridding, std::size_t part,
                                          double slew = 0.0) {
  std::vector<model::PhasePart> parts;
  for (std::size_t p = 0; p < gridding.parts; ++p) {
    if (p == part || slew > 0.0) {
      auto made = model::phase_part(tracker, cell, gridding, p);
      if (!made) {
        return std::nullopt;
      }
      parts.push_back(*std::move(made));
    }
  }
  return model::PhaseGains::make(std::move(parts), gridding, slew);
}

std::optional<model::PhaseErrors> errors_of(const std::optional<model::PhaseGains>& gains, double noise,
                                            double slew = 0.0, const std::vector<double>& start = {}) {
  return gains ? gains->errors({noise, slew, start}) : std::nullopt;
}

Eigen::VectorXd curve_at(const model::FloquetCell& cell, double phase, double frequency) {
  return test::PointTube(cell.curve).curve(phase, frequency);
}

Eigen::MatrixXd slopes(const test::Example& loop, const Eigen::VectorXd& state, double sample) {
  const model::StepMap step(loop.tracker.recursion, loop.tracker.constants);
  return step.jacobian(state, Eigen::VectorXd::Constant(1, sample));
}

/// The largest frequency error at the last of `samples` that noise of +-V reaches: signs by the adjoint along
/// the curve.
double attack(const test::Example& loop, const model::FloquetCell& cell, double frequency, double end,
              double noise, int samples) {
  const Eigen::Index n = 2;
  std::vector<double> sign(static_cast<std::size_t>(samples));
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Unit(n, 0);  // the frequency is state 0
  for (int k = samples; k-- > 0;) {
    const double phase = end - (samples - k) * frequency;
    const Eigen::MatrixXd all = slopes(loop, curve_at(cell, phase, frequency), std::cos(phase + frequency));
    sign[static_cast<std::size_t>(k)] = (row * all.col(n))(0) > 0.0 ? 1.0 : -1.0;
    row = row * all.leftCols(n);
  }
  double phase = end - samples * frequency;
  Eigen::VectorXd state = curve_at(cell, phase, frequency);
  for (int k = 0; k < samples; ++k) {
    phase += frequency;
    state =
        test::next_state(loop.tracker, state, std::cos(phase) + noise * sign[static_cast<std::size_t>(k)]);
  }
  return std::fabs(state(0) - frequency);
}

}  // namespace

TEST_CASE("a loop of one channel stays within its bounds, which attacks nearly reach") {
  const test::Example loop(test::phase_locked_loop(0.02));
  const model::TrackedTone tone = test::tone_of(loop.tracker);
  const auto cell = model::propose_floquet_cell(tone, kGauge, kLow, kHigh);
  REQUIRE(cell);
  const rigor::UpwardRounding upward;
  const auto bounds = gains_of(loop.model, *cell, {64, 1024, 32}, 0);
  REQUIRE(bounds);
  const double frequency = kLow + (kHigh - kLow) / 64.0;
  for (const double noise : {0.002, 0.02, 0.05}) {
    const auto errors = errors_of(bounds, noise);
    REQUIRE(errors);
    CHECK(errors->long_run <= errors->for_ever);
    double reached = 0.0;
    for (int i = 0; i < 16; ++i) {
      const double end = 2.0 * std::numbers::pi * i / 16.0;
      reached = std::max(reached, attack(loop, *cell, frequency, end, noise, 900));
      CHECK(reached <= errors->for_ever);
    }
    CHECK(reached >= 0.75 * errors->for_ever);
  }
  std::mt19937 random(20261129);
  std::uniform_real_distribution<double> any(-0.05, 0.05);
  const double bound = errors_of(bounds, 0.05)->for_ever;
  double phase = 0.0;
  Eigen::VectorXd state = curve_at(*cell, phase, frequency);
  for (int k = 0; k < 20000; ++k) {
    phase = std::remainder(phase + frequency, 2.0 * std::numbers::pi);
    state = test::next_state(loop.tracker, state, std::cos(phase) + any(random));
    REQUIRE(std::fabs(state(0) - frequency) <= bound);
  }
}

TEST_CASE("a slow loop stays within its bounds where late inputs are taken by turns of the phase") {
  const test::Example loop(test::phase_locked_loop(0.002));
  const auto cell = model::propose_floquet_cell(test::tone_of(loop.tracker), kGauge, kLow, kHigh);
  REQUIRE(cell);
  const rigor::UpwardRounding upward;
  // 100 blocks of 4 turns, of 87 samples or less.
  const auto bounds = gains_of(loop.model, *cell, {64, 256, 8, 100, 4, 256 + 100 * 87}, 0);
  const auto one_by_one = gains_of(loop.model, *cell, {64, 8192, 64, 0, 0, 8192}, 0);
  REQUIRE(bounds);
  REQUIRE(one_by_one);
  const double frequency = kLow + (kHigh - kLow) / 16.0;
  for (const double noise : {0.002, 0.05}) {
    const auto errors = errors_of(bounds, noise);
    const auto others = errors_of(one_by_one, noise);
    REQUIRE(errors);
    REQUIRE(others);
    double reached = 0.0;
    for (int i = 0; i < 8; ++i) {
      reached = std::max(reached, attack(loop, *cell, frequency, std::numbers::pi * i / 4.0, noise, 8000));
    }
    CHECK(reached <= errors->for_ever);
    CHECK(reached >= 0.5 * errors->for_ever);
    CHECK(errors->for_ever < 1.3 * others->for_ever);
  }
  const auto started = errors_of(bounds, 0.0, 0.0, {2e-4, 0.0});
  REQUIRE(started);
  CHECK(started->from_block.back() < 0.1 * started->from_block.front());
}

TEST_CASE("starts and a frequency that moves stay within their bounds") {
  const test::Example loop(test::phase_locked_loop(0.02));
  const auto cell = model::propose_floquet_cell(test::tone_of(loop.tracker), kGauge, kLow, kHigh);
  REQUIRE(cell);
  constexpr double kNoise = 0.01, kSlew = 1e-6, kOff = 0.002;
  const rigor::UpwardRounding upward;
  const auto gains = gains_of(loop.model, *cell, {32, 1024, 8}, 0, kSlew);
  const auto settled = errors_of(gains, kNoise, kSlew);
  const auto started = errors_of(gains, kNoise, kSlew, {kOff, 0.0});
  REQUIRE(settled);
  REQUIRE(started);
  CHECK(settled->for_ever <= started->for_ever);
  CHECK(started->from_block.back() <= started->from_block.front());
  CHECK_FALSE(errors_of(gains, kNoise, 2.0 * kSlew));
  std::mt19937 random(20261129);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  double reached = 0.0;
  for (int run = 0; run < 40; ++run) {
    double phase = 2.0 * std::numbers::pi * place(random);
    double frequency = kLow + (kHigh - kLow) * place(random);
    const double direction = run % 2 == 0 ? 1.0 : -1.0;
    Eigen::VectorXd state = curve_at(*cell, phase, frequency);
    state(0) += kOff * any(random);
    for (std::size_t k = 0; k < 2000; ++k) {
      phase = std::remainder(phase + frequency, 2.0 * std::numbers::pi);
      // The same sign most of the time: that moves the estimate further.
      const double noise = kNoise * (any(random) < 0.5 ? direction : -direction);
      state = test::next_state(loop.tracker, state, std::cos(phase) + noise);
      frequency = std::clamp(frequency + direction * kSlew, kLow, kHigh);
      const double error = std::fabs(state(0) - frequency);
      reached = std::max(reached, error);
      REQUIRE(error <= started->from_block[std::min(k * model::PhaseKernels::kBlocks / 1024,
                                                    model::PhaseKernels::kBlocks - 1)]);
    }
  }
  CHECK(reached > 0.2 * started->for_ever);
}

TEST_CASE("too much noise, and a horizon that is too short, bound nothing") {
  const test::Example loop(test::phase_locked_loop(0.02));
  const auto cell = model::propose_floquet_cell(test::tone_of(loop.tracker), kGauge, kLow, kHigh);
  REQUIRE(cell);
  const rigor::UpwardRounding upward;
  const auto bounds = gains_of(loop.model, *cell, {64, 1024, 8}, 3);
  REQUIRE(bounds);
  CHECK_FALSE(errors_of(bounds, 0.5));
  CHECK_FALSE(errors_of(bounds, NAN));
  CHECK_FALSE(errors_of(bounds, 0.01, 1e-6));  // made without a slew
  CHECK_FALSE(gains_of(loop.model, *cell, {64, 16, 8}, 3));
}

TEST_CASE("a wrong basis, matrix or curve is noticed") {
  const test::Example loop(test::phase_locked_loop(0.02));
  const auto cell = model::propose_floquet_cell(test::tone_of(loop.tracker), kGauge, kLow, kHigh);
  REQUIRE(cell);
  const rigor::UpwardRounding upward;
  const auto right = errors_of(gains_of(loop.model, *cell, {64, 1024, 8}, 3), 0.02);
  REQUIRE(right);
  const auto with = [&](auto change) {
    model::FloquetCell changed = *cell;
    change(changed);
    const auto errors = errors_of(gains_of(loop.model, changed, {64, 1024, 8}, 3), 0.02);
    return errors ? errors->for_ever : INFINITY;
  };
  // Another basis is another proof of the same bound, or none; another curve or matrix costs.
  CHECK(with([](auto& c) { c.matrix[0][0] += 1e-3; }) > 1.05 * right->for_ever);
  CHECK(with([](auto& c) { c.curve.curve[0].coefficients[0][0] += 1e-4; }) > 1.05 * right->for_ever);
  CHECK(with([](auto& c) { c.basis[0].coefficients[2][0] += 0.05; }) > 1.05 * right->for_ever);
  CHECK(with([](auto& c) { c.basis[0].coefficients[0][0] = NAN; }) == INFINITY);
}

}  // namespace veritrack
