#include "analysis/model/set/set_search.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

TEST_CASE("the largest radius that may hold is found to a few hundredths, above small ones that do not") {
  const auto between = [](double low, double high) {
    return largest_radius(1.0, [&](double radius) { return low <= radius && radius <= high; });
  };
  for (const double high : {1.5, 1.0, 0.3, 0.011}) {
    CHECK(between(0.5 * high, high) <= high);
    CHECK(between(0.5 * high, high) >= 0.95 * high);
  }
  CHECK(between(2.0, 3.0) == 0.0);
  CHECK(between(0.0, 1e-6) == 0.0);
  CHECK(largest_radius(1.0, [](double) { return false; }) == 0.0);
}

TEST_CASE("what is verified is a tenth more of the room than what is claimed") {
  CHECK(with_room(0.9) == doctest::Approx(0.89));
  CHECK(with_room(1.0) == 1.0);
  CHECK(with_room(0.99) < 0.99);
}

TEST_CASE("tubes cover a band when each begins before the last one ends") {
  const auto tube = [](double low, double high) {
    ProvedTube proved;
    proved.tube.frequency = 0.5 * (low + high);
    proved.tube.half_width = 0.5 * (high - low);
    return proved;
  };
  CHECK(covers({tube(0.25, 0.5), tube(0.5, 0.75)}, 0.25, 0.75));
  CHECK(covers({tube(0.25, 0.625), tube(0.5, 0.75)}, 0.3, 0.7));
  CHECK_FALSE(covers({tube(0.25, 0.5), tube(0.5625, 0.75)}, 0.25, 0.75));
  CHECK_FALSE(covers({tube(0.25, 0.5)}, 0.125, 0.5));
  CHECK_FALSE(covers({tube(0.25, 0.5)}, 0.25, 0.625));
  CHECK_FALSE(covers({}, 0.25, 0.5));
  // Neighbours that are a rounding apart overlap once they are wider.
  ProvedTube left = tube(0.25, 0.5);
  ProvedTube right = tube(std::nextafter(0.5, 1.0), 0.75);
  right.tube.frequency = std::nextafter(right.tube.frequency, 1.0);
  CHECK_FALSE(covers({left, right}, 0.25, 0.75));
  widen(left.tube);
  widen(right.tube);
  CHECK(covers({left, right}, 0.25, 0.75));
  CHECK(left.tube.half_width < 0.125 * (1.0 + 1e-11));
}

TEST_CASE("a tube is locked where errors are smaller than the frequency") {
  const test::Example loop(test::phase_locked_loop());
  Tube tube;
  tube.frequency = 0.5;
  tube.half_width = 0.0625;
  tube.turns = {0, 1};
  tube.curve = {{{{0.5, 0.0625}}}, {{{0.25}}}};
  tube.shape = {{{{1.0}}}, {{{0.0}}}, {{{1.0}}}};
  // w = omega + xi.
  CHECK(is_locked(loop.model, tube, 0.49));
  CHECK_FALSE(is_locked(loop.model, tube, 0.51));
}

TEST_CASE("settings of a task: objective, disturbances with the amplitudes', and how far a lock may be off") {
  TrackedTone tone = test::tone_of(test::phase_locked_loop());
  SetTask task;
  task.objective = ShapeObjective::largest_slew;
  task.noise = 0.01;
  task.slew = 1e-5;
  task.with_curve = true;
  task.deviations = Eigen::Vector2d(0.1, 0.2);
  task.largest_error = 0.05;
  const BandSettings plain = settings_of(tone, task, 0.2, 0.5);
  CHECK(plain.tube.shape.objective == ShapeObjective::largest_slew);
  CHECK(plain.tube.shape.noise == 0.01);
  CHECK(plain.tube.shape.slew == 1e-5);
  CHECK(plain.tube.shape.start == Eigen::VectorXd(Eigen::Vector2d(0.1, 0.2)));
  CHECK(plain.tube.shape.largest_reach == 0.05);
  CHECK(plain.tube.fine_curve);
  CHECK(plain.tube.steady_state.largest_mean_error == 0.5 * (0.5 - 0.2));
  CHECK(settings_of(tone, task, 0.8, 0.9).tube.steady_state.largest_mean_error == 0.25 * 0.8);
  // Samples of cos(phi) with an amplitude off by 0.02 are off by that at most.
  tone.amplitude_deviation = 0.02;
  CHECK(settings_of(tone, task, 0.2, 0.5).tube.shape.noise > 0.01 + 0.01);
  CHECK(settings_of(tone, task, 0.2, 0.5).tube.shape.noise <= 0.01 + 0.0201);
  task.largest_noise = true;
  CHECK(settings_of(tone, task, 0.2, 0.5).tube.shape.noise == 0.01);
}

TEST_CASE("the place of a cell, in words") {
  TubeProposal cell;
  cell.frequency = 0.375;
  cell.half_width = 0.125;
  CHECK(place_of_cell(cell) == "between 0.25 and 0.5 rad/sample");
}

}  // namespace
}  // namespace veritrack::model
