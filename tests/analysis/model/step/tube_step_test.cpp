#include "analysis/model/step/tube_step.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

constexpr double kRadiusOfStep = 0.125;
constexpr double kNoiseOfStep = 0.0625;

/// A tube that nothing has proposed: w = omega + ripple sin(2 phi), theta = phi + ..., with a shape that
/// changes over phase and frequency.
Tube written_tube() {
  Tube tube;
  tube.frequency = 0.3;
  tube.half_width = 0.03125;
  tube.turns = {0, 1};
  tube.curve = {{{{0.3, 0.03125}, {}, {{0.0, -0.001}}}}, {{{0.01, 0.002}, {}, {0.03, {0.0, 0.01}}}}};
  tube.shape = {
      {{{0.5, 0.0625}, {}, {0.0625}}}, {{{0.25}, {{0.0, 0.0625}}}}, {{{1.5}, {}, {{0.125, 0.0625}}}}};
  return tube;
}

/// F of the loop at a point: e = -y sin theta; w' = w + ki e; theta' = theta + w + kp e.
Eigen::Vector2d step_of_loop(const test::ExampleTracker& loop, const Tube& tube, double phase,
                             double frequency, const Eigen::Vector2d& xi, double noise,
                             double next_frequency) {
  const test::PointTube points(tube);
  const Eigen::VectorXd state = points.curve(phase, frequency) + points.shape(phase, frequency) * xi;
  const double e = -(std::cos(phase + frequency) + noise) * std::sin(state[1]);
  const Eigen::Vector2d next(state[0] + loop.constants[0] * e, state[1] + state[0] + loop.constants[1] * e);
  return points.shape(phase + frequency, next_frequency)
      .triangularView<Eigen::Lower>()
      .solve(next - points.curve(phase + frequency, next_frequency));
}

/// A random place in a cell.
struct PlaceInCell {
  double phase, frequency;
  PlaceInCell(test::Random& random, const Tube& tube, const TubeCell& cell) {
    const double turn = cell.turn + cell.half_turn * random.uniform(-1.0, 1.0);
    const double z = cell.z + cell.half_z * random.uniform(-1.0, 1.0);
    phase = 2.0 * std::numbers::pi * turn;
    frequency = tube.frequency + tube.half_width * z;
  }
};

Eigen::Vector2d on_rim(test::Random& random) {
  const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
  return {std::cos(angle), std::sin(angle)};
}

TEST_CASE("no step from a tube, of any scale, is longer than the bounds over a cell, and some are nearly") {
  const test::Example loop(test::phase_locked_loop());
  const Tube tube = written_tube();
  test::Random random(66);
  const std::vector<double> scales{1.0, 0.5, 0.125};
  for (const double slew : {0.0, 0.001}) {
    double closest = 0.0;
    for (int trial = 0; trial < 12; ++trial) {
      const double turn = (2.0 * static_cast<double>(random.below(32)) + 1.0) / 64.0;
      const double z = random.below(2) == 0 ? -0.5 : 0.5;
      const TubeCell cell{turn, 1.0 / 64.0, z, 0.5};
      const StepBounds bounds = bound_step(loop.model, tube, cell, kRadiusOfStep, kNoiseOfStep, scales, slew);
      REQUIRE(bounds.steps.size() == 3);
      for (int sample = 0; sample < 300; ++sample) {
        const PlaceInCell place(random, tube, cell);
        const std::size_t which = random.below(3);
        const Eigen::Vector2d xi = kRadiusOfStep * scales[which] * on_rim(random);
        const double noise = random.below(2) == 0 ? kNoiseOfStep : -kNoiseOfStep;
        const double moved = place.frequency + slew * random.uniform(-1.0, 1.0);
        const double length =
            step_of_loop(loop.tracker, tube, place.phase, place.frequency, xi, noise, moved).norm();
        REQUIRE(length <= bounds.steps[which]);
        closest = std::max(closest, length / bounds.steps[which]);
        const test::PointTube points(tube);
        const Eigen::VectorXd state =
            points.curve(place.phase, place.frequency) + points.shape(place.phase, place.frequency) * xi;
        REQUIRE(state[0] - place.frequency <= bounds.frequency_error.upper());
        REQUIRE(state[0] - place.frequency >= bounds.frequency_error.lower());
      }
    }
    CHECK(closest > 0.85);
    CHECK(closest < 1.0);
  }
}

TEST_CASE("noise and slew at their largest together, in the same direction, are within the bounds") {
  const test::Example loop(test::phase_locked_loop());
  Tube tube = written_tube();
  tube.shape[1] = {{{6.0}}};  // what the slew does to w is then much of what noise does to theta
  constexpr double kLittle = 1e-6;
  constexpr double kSlew = 0.0003;
  double closest = 0.0;
  for (int place = 0; place < 32; ++place) {
    const TubeCell cell{(2.0 * place + 1.0) / 64.0, 0x1p-14, 0.25, 0x1p-10};
    const StepBounds bounds = bound_step(loop.model, tube, cell, kLittle, kNoiseOfStep, {1.0}, kSlew);
    const double phase = 2.0 * std::numbers::pi * cell.turn;
    const double frequency = tube.frequency + tube.half_width * cell.z;
    for (const double noise : {kNoiseOfStep, -kNoiseOfStep}) {
      for (const double slew : {kSlew, -kSlew}) {
        const double length = step_of_loop(loop.tracker, tube, phase, frequency, Eigen::Vector2d::Zero(),
                                           noise, frequency + slew)
                                  .norm();
        REQUIRE(length <= bounds.steps.front());
        closest = std::max(closest, length / bounds.steps.front());
      }
    }
  }
  CHECK(closest > 0.9);
}

TEST_CASE("smaller cells have sharper bounds, and the shares tell which side to halve") {
  const test::Example loop(test::phase_locked_loop());
  const Tube tube = written_tube();
  const auto bound = [&](double half_turn, double half_z) {
    return bound_step(loop.model, tube, {0.25, half_turn, 0.0, half_z}, kRadiusOfStep, 0.0, {1.0});
  };
  const StepBounds wide = bound(1.0 / 16.0, 1.0);
  const StepBounds fine = bound(1.0 / 256.0, 1.0 / 16.0);
  CHECK(fine.steps.front() < wide.steps.front());
  const StepBounds long_in_phase = bound(1.0 / 16.0, 1.0 / 64.0);
  CHECK(long_in_phase.by_phase > long_in_phase.by_frequency);
  const StepBounds long_in_frequency = bound(1.0 / 1024.0, 1.0);
  CHECK(long_in_frequency.by_frequency > long_in_frequency.by_phase);
}

TEST_CASE("disturbances are there with noise, or with an amplitude that varies") {
  test::Example loop(test::phase_locked_loop());
  CHECK_FALSE(is_disturbed(loop.model, 0.0));
  CHECK(is_disturbed(loop.model, 0.01));
  loop.model.amplitude_varies = true;
  CHECK(is_disturbed(loop.model, 0.0));
}

TEST_CASE("of a shape that vanishes in the cell, and of sizes that do not fit") {
  const test::Example loop(test::phase_locked_loop());
  Tube tube = written_tube();
  tube.shape[2].coefficients[0][0] = 0.125;  // 0.125 + about 0.14 cos(2 phi + ...)
  const TubeCell whole{0.5, 0.5, 0.0, 1.0};
  const StepBounds none = bound_step(loop.model, tube, whole, kRadiusOfStep, 0.0, {1.0, 0.5});
  REQUIRE(none.steps.size() == 2);
  CHECK_FALSE(std::isfinite(none.steps[0]));
  CHECK_FALSE(std::isfinite(none.steps[1]));
  CHECK(rigor::is_empty(none.frequency_error));
  tube.curve.pop_back();
  CHECK_THROWS_AS((void)bound_step(loop.model, tube, whole, kRadiusOfStep, 0.0, {1.0}),
                  std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::model
