#include "analysis/model/tube/tube_errors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/model/tube/tube_proposal.hpp"
#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

/// One state with curve = bias + ripple cos(phi) + slope z, shape = size; the frequency is the state.
struct Line {
  trackers::Recursion recursion;
  trackers::StraightLineProgram signal{2};
  TrackerModel model;
  Tube tube;

  explicit Line(const trackers::StraightLineProgram& frequency) {
    recursion.states = 1;
    recursion.samples = 1;
    recursion.is_angle = {false};
    recursion.step = trackers::StraightLineProgram(2);
    recursion.step.add_result(0);
    recursion.frequency = frequency;
    signal.add_result(0);
    model.recursion = &recursion;
    model.signal = &signal;
    model.amplitude = Interval(1.0);
    tube.frequency = 1.0;
    tube.half_width = 0.125;
    tube.turns = {0};
    tube.curve = {{{{1.03125, 0.125}, {0.0625}}}};
    tube.shape = {{{{0.5}}}};
  }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  Line(Line&&) = delete;
  Line& operator=(Line&&) = delete;
  ~Line() = default;
};

trackers::StraightLineProgram state_itself() {
  trackers::StraightLineProgram program(1);
  program.add_result(0);
  return program;
}

TEST_CASE("errors in a tube whose errors are known") {
  const Line line(state_itself());
  // h - omega = 1.03125 + 0.125 z + 0.0625 cos(phi) + 0.5 xi - (1 + 0.125 z).
  const TubeErrors errors = bound_errors(line.model, line.tube, 0.015625, {});
  const double around = 0.0078125;
  CHECK(errors.error.lower() <= 0.03125 - 0.0625 - around);
  CHECK(errors.error.lower() >= 0.03125 - 0.0625 - around - 1e-4);
  CHECK(errors.error.upper() >= 0.03125 + 0.0625 + around);
  CHECK(errors.error.upper() <= 0.03125 + 0.0625 + around + 1e-4);
  CHECK(errors.mean.lower() <= 0.03125 - around);
  CHECK(errors.mean.lower() >= 0.03125 - around - 1e-7);
  CHECK(errors.mean.upper() <= 0.03125 + around + 1e-7);
  CHECK(errors.ripple >= 0.125 + 2.0 * around);
  CHECK(errors.ripple <= 0.125 + 2.0 * around + 2e-4);
  REQUIRE(errors.slices.size() == 4);
  CHECK(errors.slices.front().low == 0.875);
  CHECK(errors.slices.back().high == 1.125);
  // Where the curve is above omega by more than the tube is wide there is no state with an error below 0.
  CHECK(bound_reach(line.model, line.tube, 0.015625, {}) == 0.0);
  // |xi| <= 1: to 0.03125 + 0.0625 - 0.5 at most, at every phase.
  const double reach = bound_reach(line.model, line.tube, 1.0, {});
  CHECK(reach <= 0.5 - 0.09375);
  CHECK(reach >= 0.5 - 0.09375 - 1e-4);
  const double level = bound_start(line.model, line.tube, {Interval(0.25)}, {});
  CHECK(level >= 0.5);
  CHECK(level <= 0.5 + 1e-9);
  CHECK(bound_start(line.model, line.tube, {Interval(0.0)}, {}) <= 1e-9);
  CHECK_THROWS_AS((void)bound_start(line.model, line.tube, {}, {}), std::invalid_argument);
  CHECK_THROWS_AS((void)bound_errors(line.model, line.tube, 1.0, {3, 1}), std::invalid_argument);
}

TEST_CASE("a frequency that is undefined somewhere in the tube is not known") {
  trackers::StraightLineProgram root(1);
  root.add_result(root.append(trackers::Operation::sqrt, 0));
  const Line line(root);
  const rigor::UpwardRounding upward;
  CHECK(rigor::is_finite(bound_errors(line.model, line.tube, 0.5, {}).error));
  const TubeErrors unknown = bound_errors(line.model, line.tube, 3.0, {});
  CHECK(rigor::is_empty(unknown.error));
  CHECK(rigor::is_empty(unknown.mean));
  CHECK_FALSE(std::isfinite(unknown.ripple));
  CHECK(unknown.slices.empty());
  CHECK(bound_reach(line.model, line.tube, 3.0, {}) == 0.0);
}

TEST_CASE("a ripple that changes with the frequency does not blur the mean over the phase") {
  const Line line(state_itself());
  Tube tube = line.tube;
  // (0.0625 + 0.25 z) cos(phi): its mean over the phase is 0 for each z.
  tube.curve[0].coefficients.at(1).assign({0.0625, 0.25});
  const TubeErrors errors = bound_errors(line.model, tube, 0.015625, {});
  const double around = 0.0078125;
  CHECK(errors.mean.lower() <= 0.03125 - around);
  CHECK(errors.mean.upper() >= 0.03125 + around);
  CHECK(errors.mean.lower() >= 0.03125 - around - 1e-6);
  CHECK(errors.mean.upper() <= 0.03125 + around + 1e-6);
  // A mean that changes with the frequency is still all of it: 0.03125 + 0.125 z - 0.0625 z^2.
  tube.curve[0].coefficients.at(0).assign({1.03125, 0.25, -0.0625});
  const TubeErrors moving = bound_errors(line.model, tube, 0.015625, {128, 1});
  CHECK(moving.mean.lower() <= 0.03125 - 0.125 - 0.0625 - around);
  CHECK(moving.mean.upper() >= 0.03125 + 0.125 - 0.0625 + around);
  CHECK(moving.mean.upper() <= 0.03125 + 0.125 + around + 1e-6);
}

TEST_CASE("a ripple is that of each frequency by itself, and finer parts make it sharp") {
  const Line line(state_itself());
  Tube tube = line.tube;
  // 0.03125 + 0.125 z - 0.0625 z^2 + 0.0625 cos(phi): 0.125 and the width of the tube, at every frequency.
  tube.curve[0].coefficients.at(0).assign({1.03125, 0.25, -0.0625});
  const double ripple = 0.125 + 2.0 * 0.0078125;
  const double coarse = bound_errors(line.model, tube, 0.015625, {128, 1}).ripple;
  CHECK(coarse >= ripple);
  CHECK(coarse <= ripple + 2e-4);
  CHECK(coarse >= ripple + 1e-5);
  const double fine = bound_errors(line.model, tube, 0.015625, {128, 1, 16}).ripple;
  CHECK(fine >= ripple);
  CHECK(fine <= ripple + 2e-6);
  // (0.0625 + 0.03125 z) cos(phi): that of the frequency where it is largest.
  tube.curve[0].coefficients.at(1).assign({0.0625, 0.03125});
  const double largest = bound_errors(line.model, tube, 0.015625, {128, 1, 16}).ripple;
  CHECK(largest >= 0.1875 + 2.0 * 0.0078125);
  CHECK(largest <= 0.1875 + 2.0 * 0.0078125 + 2e-6);
  CHECK_THROWS_AS((void)bound_errors(line.model, tube, 0.015625, {128, 1, 3}), std::invalid_argument);
}

TEST_CASE("random states of a phase-locked loop's tube are within its bounds") {
  const test::Example loop(test::phase_locked_loop());
  TubeSettings settings;
  const TubeProposal proposal = propose_tube(test::tone_of(loop.tracker), 0.3, 0.02, settings);
  REQUIRE(proposal.tube.has_value());
  const Tube& tube = *proposal.tube;
  const TubeErrors errors = bound_errors(loop.model, tube, 0.01, {});
  const double reach = bound_reach(loop.model, tube, 0.01, {});
  const double level = bound_start(loop.model, tube, {Interval(0.002), Interval(0.01)}, {});
  const test::PointTube points(tube);
  test::Random random(5);
  double worst = 0.0;
  for (int trial = 0; trial < 2000; ++trial) {
    const double phase = random.uniform(0.0, 2.0 * M_PI);
    const double z = random.uniform(-1.0, 1.0);
    const Eigen::Vector2d xi(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const double frequency = tube.frequency + tube.half_width * z;
    const Eigen::MatrixXd shape = points.shape(phase, frequency);
    const Eigen::VectorXd state = points.curve(phase, frequency) + 0.01 * shape * xi.normalized();
    const double error = state[0] - frequency;
    worst = std::max(worst, std::fabs(error));
    CHECK(error <= errors.error.upper());
    CHECK(error >= errors.error.lower());
    const Eigen::Vector2d start(random.below(2) == 0 ? 0.002 : -0.002, random.below(2) == 0 ? 0.01 : -0.01);
    CHECK(shape.triangularView<Eigen::Lower>().solve(start).norm() <= level);
  }
  CHECK(worst > 0.9 * errors.error.upper());
  CHECK(reach > 0.0);
  CHECK(reach < worst);
}

}  // namespace
}  // namespace veritrack::model
