// A step over a cell of phases and frequencies at points of the cell: against differences of single steps in
// floating point, along curves and bases that are no steady states.
#include "analysis/model/gain/phase_step.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "analysis/model/gain/floquet_proposal.hpp"
#include "analysis/model/gain/frame_value.hpp"
#include "tests/analysis/model/floquet_points.hpp"
#include "tests/analysis/model/gain_examples.hpp"
#include "tests/analysis/model/phase_points.hpp"
#include "tests/support/oracles.hpp"

namespace veritrack::model {
namespace {

struct StepCase {
  const test::ExampleTracker* tracker;
  const TrackerModel* model;
  TrackedTone tone;
  double low, high;
  double errors;  ///< of the states, at most
};

/// Each entry within its error of what it should be.
void check_models(const std::vector<rigor::BallModel>& models, const Eigen::VectorXd& expected,
                  const test::PhasePoint& at, double room) {
  REQUIRE(static_cast<Eigen::Index>(models.size()) == expected.size());
  for (std::size_t i = 0; i < models.size(); ++i) {
    const double far =
        std::fabs(test::polynomial_at(models[i], at.s, at.z) - expected(static_cast<Eigen::Index>(i)));
    REQUIRE(far <= models[i].error() + room);
  }
}

void check_columns(const std::vector<std::vector<rigor::BallModel>>& rows, const Eigen::MatrixXd& expected,
                   const test::PhasePoint& at, double room) {
  REQUIRE(static_cast<Eigen::Index>(rows.size()) == expected.rows());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    check_models(rows[i], expected.row(static_cast<Eigen::Index>(i)).transpose(), at, room);
  }
}

/// The share of the room for remainders that a step of these errors and this noise takes, at most; none of it
/// is passed.
double remainder_share(const PhaseStep& step, const test::PhasePoint& at,
                       const Eigen::VectorXd& beyond_linear, double room) {
  const std::vector<double> sizes = test::sizes_at(step, at);
  double share = 0.0;
  for (Eigen::Index i = 0; i < beyond_linear.size(); ++i) {
    double most = 0.0;
    for (const int gate : step.gates) {
      const rigor::BallModel& column = step.columns.at(gate)[static_cast<std::size_t>(i)];
      most += (std::fabs(test::polynomial_at(column, at.s, at.z)) + column.error()) *
              sizes[static_cast<std::size_t>(gate)];
    }
    if (most < INFINITY) {
      REQUIRE(std::fabs(beyond_linear(i)) <= most + room);
      share = std::max(share, most > 1e-6 ? std::fabs(beyond_linear(i)) / most : 0.0);
    }
  }
  return share;
}

double attack_step(const StepCase& of, double disturbance, std::uint64_t stream) {
  test::Random random(stream);
  const auto proposed = propose_floquet_cell(of.tone, FloquetGauge::by_mode, of.low, of.high);
  REQUIRE(proposed);
  const FloquetCell cell = test::disturbed(*proposed, disturbance, random);
  const test::FloquetPoints points(*of.tracker, cell);
  const auto n = static_cast<Eigen::Index>(cell.states());
  const int channels = of.tracker->recursion.samples;
  const rigor::BallModelScope scope(0, 0);
  double reached = 0.0;
  for (std::int64_t trial = 0; trial < test::effort(60); ++trial) {
    TubeCell part;
    part.half_turn = 0x1p-7;
    part.turn = static_cast<double>(random.below(64)) * 0x1p-6 + part.half_turn;
    part.half_z = 0x1p-4;
    part.z = static_cast<double>(random.below(16)) * 0x1p-3 - 1.0 + part.half_z;
    const PhaseStep step = phase_step(*of.model, cell, part);
    test::PhasePoint at = test::random_point(random);
    const double phase = 2.0 * std::numbers::pi * (part.turn + part.half_turn * at.s);
    const double omega = cell.curve.frequency + cell.curve.half_width * (part.z + part.half_z * at.z);
    const Eigen::MatrixXd slopes = points.slopes(phase, omega);
    constexpr double kRoom = 1e-7;  // of differences
    check_columns(step.matrix, slopes.leftCols(n), at, kRoom);
    for (int c = 0; c < channels; ++c) {
      check_models(step.columns.at(c), slopes.col(n + c), at, kRoom);
    }
    const double later = phase + omega;
    const Eigen::MatrixXd there = points.basis(later, omega);
    check_columns(step.inverse, there.inverse(), at, 1e-9);
    constexpr double kStep = 1e-6;
    const auto slope_of = [&](auto function) -> Eigen::MatrixXd {
      return oracle::solution(there, (function(omega + kStep) - function(omega - kStep)) / (2.0 * kStep));
    };
    check_columns(step.basis_slope, slope_of([&](double w) { return points.basis(later, w); }), at, 1e-5);
    check_models(step.slew, -slope_of([&](double w) { return points.curve(later, w); }), at, 1e-5);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
    const Eigen::VectorXd quiet = Eigen::VectorXd::Zero(channels);
    const Eigen::VectorXd residual = points.after(phase, omega, omega, none, quiet);
    check_models(step.residual, residual, at, 1e-10);
    const double bias = points.frequency_of(points.curve(phase, omega)) - omega;
    REQUIRE(std::fabs(test::polynomial_at(step.bias, at.s, at.z) - bias) <= step.bias.error() + 1e-12);

    const Eigen::VectorXd eta = test::random_vector(random, n, of.errors);
    const Eigen::VectorXd noise = test::random_vector(random, channels, 0.2 * of.errors);
    at.states.assign(eta.begin(), eta.end());
    at.noise.assign(noise.begin(), noise.end());
    const Eigen::VectorXd beyond = points.after(phase, omega, omega, eta, noise) - residual -
                                   slopes.leftCols(n) * eta - slopes.rightCols(channels) * noise;
    reached = std::max(reached, remainder_share(step, at, beyond, kRoom));
  }
  return reached;
}

/// The part of a recursion that reads the frequency, in place of its own: over constants and states.
template <typename Build>
auto state_of_frequency(const test::Example& loop, const FloquetCell& cell, const Build& build) {
  test::Recursion changed = loop.tracker.recursion;
  test::StraightLineProgram frequency(changed.constants + changed.states);
  frequency.add_result(build(frequency));
  changed.frequency = frequency;
  TrackerModel tracker = loop.model;
  tracker.recursion = &changed;
  const rigor::BallModelScope scope(0, 0);
  return phase_step(tracker, cell, {0.125, 0.125, 0.0, 1.0}).frequency_state;
}

}  // namespace

TEST_CASE("a step's matrix, columns, residual and slew are what single steps do, at every point of a cell") {
  const test::Example one(test::phase_locked_loop(0.02));
  const test::Example integrator(test::integrator_loop());
  const test::TwoChannelExample two(test::angle_loop());
  for (const double disturbance : {0.0, 0.01}) {
    const StepCase loop{&one.tracker, &one.model, test::tone_of(one.tracker), 0.29, 0.31, 0.3};
    CHECK(attack_step(loop, disturbance, 961) > 0.3);
    const StepCase states{
        &integrator.tracker, &integrator.model, test::tone_of(integrator.tracker), 0.03, 0.032, 0.5};
    CHECK(attack_step(states, disturbance, 962) > 0.03);
    CHECK(attack_step({&two.tracker, &two.model, two.tone, 0.29, 0.31, 0.1}, disturbance, 963) > 0.03);
  }
}

TEST_CASE("the last form is the frequency error, and its state is known where that is a multiple of it") {
  const test::Example loop(test::phase_locked_loop(0.02));
  const auto cell = propose_floquet_cell(test::tone_of(loop.tracker), FloquetGauge::by_mode, 0.29, 0.31);
  REQUIRE(cell);
  using Program = test::StraightLineProgram;
  using test::Operation;
  // Constants ki, kp; states w, theta.
  const auto scaled = state_of_frequency(loop, *cell, [](Program& p) {
    return p.append(Operation::negate, p.append(Operation::multiply, 1, 2));
  });
  REQUIRE(scaled);
  CHECK(scaled->first == 0);
  CHECK(rigor::contains(scaled->second, -loop.tracker.constants[1]));
  CHECK(rigor::width(scaled->second) < 1e-14);
  CHECK_FALSE(state_of_frequency(loop, *cell, [](Program& p) { return p.append(Operation::add, 2, 3); }));
  CHECK_FALSE(
      state_of_frequency(loop, *cell, [](Program& p) { return p.append(Operation::multiply, 2, 2); }));
  CHECK_FALSE(state_of_frequency(loop, *cell, [](Program&) { return 0; }));

  const test::FloquetPoints points(loop.tracker, *cell);
  const rigor::BallModelScope scope(0, 0);
  const PhaseStep step = phase_step(loop.model, *cell, {0.125, 0.125, 0.0, 1.0});
  for (std::size_t j = 0; j < 2; ++j) {  // the row of w in the basis, at the end of the cell
    const double expected = points.basis(0.5 * std::numbers::pi, 0.31)(0, static_cast<Eigen::Index>(j));
    const rigor::BallModel& found = step.forms.back().states[j];
    CHECK(std::fabs(test::polynomial_at(found, 1.0, 1.0) - expected) <= found.error() + 1e-12);
  }
}

TEST_CASE("a limit beside the results is a condition on a form of its own") {
  const test::Example loop(test::phase_locked_loop(0.02));
  const auto cell = propose_floquet_cell(test::tone_of(loop.tracker), FloquetGauge::by_mode, 0.29, 0.31);
  REQUIRE(cell);
  test::Recursion changed = loop.tracker.recursion;
  changed.step.add_limit(changed.step.append(test::Operation::stays_within, 2, 0, 1));
  TrackerModel tracker = loop.model;
  tracker.recursion = &changed;
  const rigor::BallModelScope scope(0, 0);
  const TubeCell place{0.125, 0.125, 0.0, 1.0};
  const PhaseStep without = phase_step(loop.model, *cell, place);
  const PhaseStep step = phase_step(tracker, *cell, place);
  CHECK(step.columns.size() == without.columns.size());
  REQUIRE(step.forms.size() > without.forms.size());
  const auto is_kept = [&](double bound) {
    const std::vector<double> bounds(step.forms.size(), bound);
    bool all = true;
    for (const PhaseForm& form : step.forms) {
      for (const DirectWeight& each : form.direct) {
        const PhaseInput& input = step.inputs[static_cast<std::size_t>(each.input)];
        all = all && !(input.size && each.weight > 0.0 && input.size(bounds) == INFINITY);
      }
    }
    return all;
  };
  CHECK_FALSE(is_kept(1e3));
}

}  // namespace veritrack::model
