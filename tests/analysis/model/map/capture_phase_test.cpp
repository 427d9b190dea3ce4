#include "analysis/model/map/capture_phase.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "analysis/rigor/rounding.hpp"
#include "tests/analysis/model/capture/capture_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

/// w up to 0.002 off the curve, theta in four cells: near it, two further off, and one with the unstable
/// equilibrium.
CaptureGrid grid_of_phase() {
  CaptureGrid grid;
  grid.x_state = 1;
  grid.y_state = 0;
  grid.x = {-0.05, 0.1, 0.8, 0.9, 3.3};
  grid.y = {-0.002, 0.002};
  return grid;
}
constexpr std::size_t kCellsOfPhase = 4;

CaptureOptions options_of_phase(const test::CaptureExample& example) {
  CaptureOptions options;
  options.most_samples = 400;
  options.most_steps = 4000;
  options.tolerance = 0.05 * (1.0 - example.proved.shrinking.back());
  return options;
}

TEST_CASE("starts that are captured over a cell of phases are in the tube in time, by the loop's formula") {
  const test::CaptureExample example;
  const rigor::UpwardRounding upward;
  const CaptureGrid grid = grid_of_phase();
  const PhaseCell cell{0.28125, 0.03125};
  const PhaseAnswer answer = follow_at(example.problem, grid, {1, 0, 1, 0}, options_of_phase(example), cell);
  REQUIRE(answer.outcomes.size() == kCellsOfPhase);
  CHECK(answer.outcomes[0] == CaptureOutcome::captured);
  CHECK(answer.outcomes[1] == CaptureOutcome::not_wanted);
  CHECK(answer.outcomes[2] == CaptureOutcome::captured);
  CHECK(answer.outcomes[3] == CaptureOutcome::not_wanted);
  test::Random random(69);
  for (const std::size_t column : {std::size_t{0}, std::size_t{2}}) {
    for (int trial = 0; trial < 30; ++trial) {
      const double phase = 2.0 * std::numbers::pi * (cell.turn + cell.half_turn * random.uniform(-1.0, 1.0));
      test::CaptureExample::State state = example.start(phase, random.uniform(grid.y[0], grid.y[1]),
                                                        random.uniform(grid.x[column], grid.x[column + 1]));
      const auto here = [&](std::size_t k) {
        return static_cast<long double>(phase) + static_cast<long double>(k) * 0.35;
      };
      for (std::size_t k = 1; k <= answer.samples[column]; ++k) {
        state = example.next(state, here(k), 0.0);
      }
      CHECK(example.level(state, here(answer.samples[column])) <= example.problem.level * (1.0 + 1e-9));
    }
  }
  // Starts of the tube itself are in it at once; those further off are later.
  CHECK(answer.samples[2] > 0);
  CHECK(answer.samples[0] < answer.samples[2]);
}

TEST_CASE("what is given up: too few samples, and starts at which the loop does not pull in") {
  const test::CaptureExample example;
  const rigor::UpwardRounding upward;
  const CaptureGrid grid = grid_of_phase();
  CaptureOptions options = options_of_phase(example);
  const PhaseCell cell{0.28125, 0.03125};
  options.most_steps = 200;
  CHECK(follow_at(example.problem, grid, {0, 0, 0, 1}, options, cell).outcomes[3] !=
        CaptureOutcome::captured);
  options.most_steps = 4000;
  options.most_samples = 2;
  const PhaseAnswer soon = follow_at(example.problem, grid, {0, 0, 1, 0}, options, cell);
  CHECK(soon.outcomes[2] != CaptureOutcome::captured);
  CHECK(soon.outcomes[2] != CaptureOutcome::not_wanted);
}

}  // namespace
}  // namespace veritrack::model
