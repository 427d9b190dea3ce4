#include "analysis/model/map/capture_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "analysis/model/map/capture_basin.hpp"
#include "tests/analysis/model/capture/capture_examples.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

constexpr std::size_t kTheta = 1;
constexpr std::size_t kW = 0;

/// Random starts in proved cells, at random phases and with random noise, are in the tube in time and stay.
void check_starts(const test::CaptureExample& example, const CaptureGrid& grid,
                  const std::vector<CapturedCell>& cells, std::uint64_t stream) {
  test::Random random(stream);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (!cells[cell].is_proved) {
      continue;
    }
    const std::size_t column = cell % grid.columns();
    const std::size_t row = cell / grid.columns();
    for (std::int64_t round = 0; round < test::effort(6); ++round) {
      const double theta = random.uniform(grid.x[column], grid.x[column + 1]);
      const double w = random.uniform(grid.y[row], grid.y[row + 1]);
      const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
      test::CaptureExample::State state = example.start(phase, w, theta);
      const auto here = [&](std::size_t k) {
        return static_cast<long double>(phase) + static_cast<long double>(k) * 0.35;
      };
      for (std::size_t k = 1; k <= cells[cell].samples + 50; ++k) {
        const double noise = example.problem.noise * (random.below(2) == 0 ? 1.0 : -1.0);
        state = example.next(state, here(k), noise);
        if (k >= cells[cell].samples) {
          CHECK(example.level(state, here(k)) <= example.problem.level * (1.0 + 1e-9));
        }
      }
    }
  }
}

CaptureOptions options_for(const test::CaptureExample& example, const SimulatedStarts& simulated) {
  CaptureOptions options;
  options.phases = 16;
  options.most_samples = 2 * simulated.longest + 64;
  options.most_steps = 40'000;
  options.tolerance = 0.05 * (1.0 - example.proved.shrinking.back());
  return options;
}

std::vector<char> those_that_lock(const SimulatedStarts& simulated) {
  std::vector<char> wanted(simulated.locked.size(), 0);
  for (std::size_t cell = 0; cell < wanted.size(); ++cell) {
    wanted[cell] = simulated.locks(cell) ? 1 : 0;
  }
  return wanted;
}

TEST_CASE("a map: far more than the certified set is captured, and random starts confirm it") {
  const test::CaptureExample example;
  const CaptureGrid grid = capture_grid(kTheta, 1.2, kW, 0.036, 6);
  const SimulatedStarts simulated = simulate_starts(example.problem, grid, 4, 3000);
  CHECK(std::all_of(simulated.locked.begin(), simulated.locked.end(), [](int n) { return n == 4; }));
  const CaptureOptions options = options_for(example, simulated);
  const std::vector<char> wanted = those_that_lock(simulated);
  double told = 0.0;
  const auto cells =
      prove_captured(example.problem, grid, wanted, options, [&](double share) { told = share; });
  CHECK(told == 1.0);
  const auto proved =
      std::count_if(cells.begin(), cells.end(), [](const CapturedCell& cell) { return cell.is_proved; });
  MESSAGE(proved << " of 36 cells");
  CHECK(proved >= 20);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    // Nothing is captured before a simulation is, up to the stride.
    CHECK(
        (!cells[cell].is_proved || cells[cell].samples + options.stride + 8 >= simulated.samples[cell] / 2));
    CHECK((cells[cell].is_proved || cells[cell].samples == 0));
  }
  check_starts(example, grid, cells, 2300);
  // What is not wanted is not proved.
  std::vector<char> few(grid.cells(), 0);
  few[grid.cell(3, 3)] = 1;
  const auto one = prove_captured(example.problem, grid, few, options);
  for (std::size_t cell = 0; cell < one.size(); ++cell) {
    CHECK(one[cell].is_proved == (cell == grid.cell(3, 3)));
  }
}

TEST_CASE("ring by ring: what is proved of a ring stays when the deadline ends the next one") {
  const test::CaptureExample example;
  const CaptureGrid grid = capture_grid(kTheta, 0.6, kW, 0.018, 4);
  const SimulatedStarts simulated = simulate_starts(example.problem, grid, 4, 3000);
  CaptureOptions options = options_for(example, simulated);
  const std::vector<char> wanted(grid.cells(), 1);
  options.rings = 2;
  std::atomic<bool> stop{false};
  options.deadline = search::Deadline().or_when(stop);
  const auto cells = prove_captured(example.problem, grid, wanted, options, [&](double share) {
    stop = share >= 0.5;  // the inner ring is done
  });
  for (const std::size_t column : {0U, 1U, 2U, 3U}) {
    for (const std::size_t row : {0U, 1U, 2U, 3U}) {
      const bool is_inner = column % 3 != 0 && row % 3 != 0;
      const CapturedCell& cell = cells[grid.cell(column, row)];
      CHECK(cell.is_unfinished == !is_inner);
      CHECK(cell.is_proved == is_inner);
      CHECK((cell.samples > 0) == is_inner);
    }
  }
  stop = true;
  options.deadline = search::Deadline().or_when(stop);
  for (const CapturedCell& cell : prove_captured(example.problem, grid, wanted, options)) {
    CHECK_FALSE(cell.is_proved);
    CHECK(cell.is_unfinished);
  }
  options.deadline = {};
  options.rings = 0;
  CHECK_THROWS_AS((void)prove_captured(example.problem, grid, wanted, options), std::invalid_argument);
}

TEST_CASE("with noise") {
  const test::CaptureExample example(0.015);
  const CaptureGrid grid = capture_grid(kTheta, 0.4, kW, 0.008, 2);
  const SimulatedStarts simulated = simulate_starts(example.problem, grid, 4, 3000);
  const auto cells =
      prove_captured(example.problem, grid, those_that_lock(simulated), options_for(example, simulated));
  CHECK(std::any_of(cells.begin(), cells.end(), [](const CapturedCell& cell) { return cell.is_proved; }));
  check_starts(example, grid, cells, 2301);
}

TEST_CASE("starts that are given up: too few samples, too few steps, the unstable equilibrium") {
  const test::CaptureExample example;
  const CaptureGrid grid = capture_grid(kTheta, 0.9, kW, 0.02, 1);
  CaptureOptions options;
  options.phases = 8;
  options.tolerance = 1e-3;
  options.most_steps = 10'000;
  options.most_samples = 8;
  CHECK_FALSE(prove_captured(example.problem, grid, {1}, options).front().is_proved);
  options.most_samples = 500;
  options.most_steps = 20;
  CHECK_FALSE(prove_captured(example.problem, grid, {1}, options).front().is_proved);
  options.most_steps = 2'000;
  CaptureGrid unstable = grid;
  unstable.x = {3.0, 3.3};
  unstable.y = {-0.01, 0.01};
  CHECK_FALSE(prove_captured(example.problem, unstable, {1}, options).front().is_proved);
}

TEST_CASE("grids, and sizes that do not fit") {
  const test::CaptureExample example;
  const CaptureGrid grid = capture_grid(0, 2.0, 1, 3.0, 4);
  CHECK(grid.x == std::vector<double>{-2.0, -1.0, 0.0, 1.0, 2.0});
  CHECK(grid.y.front() == -3.0);
  CHECK(grid.cells() == 16);
  CHECK_THROWS_AS((void)capture_grid(0, 2.0, 0, 3.0, 4), std::invalid_argument);
  CHECK_THROWS_AS((void)capture_grid(0, 0.0, 1, 3.0, 4), std::invalid_argument);
  CHECK_THROWS_AS((void)capture_grid(0, 1.0, 1, INFINITY, 4), std::invalid_argument);
  CHECK_THROWS_AS((void)prove_captured(example.problem, grid, {1, 1}, {}), std::invalid_argument);
  CaptureOptions odd;
  odd.phases = 3;
  CHECK_THROWS_AS((void)prove_captured(example.problem, grid, std::vector<char>(16, 1), odd),
                  std::invalid_argument);
}

}  // namespace
}  // namespace veritrack::model
