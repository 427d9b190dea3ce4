#include "analysis/model/map/capture_basin.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/analysis/model/capture/capture_examples.hpp"

namespace veritrack::model {
namespace {

constexpr std::size_t kStateW = 0;
constexpr std::size_t kStateTheta = 1;

TEST_CASE("the edge of the section is where starts have the tube's level at their worst phase") {
  const test::CaptureExample example;
  const auto edge = edge_of_section(example.problem, kStateTheta, 0.5, kStateW, 0.01, 12);
  REQUIRE(edge.size() == 13);
  CHECK(edge.front() == edge.back());
  for (const auto& [theta, w] : edge) {
    double most = 0.0;
    for (int j = 0; j < 64; ++j) {
      const double phase = 2.0 * std::numbers::pi * j / 64;
      most = std::max(most, example.level(example.start(phase, w, theta), phase));
    }
    CHECK(most == doctest::Approx(example.problem.level).epsilon(1e-6));
  }
}

TEST_CASE("simulated starts lock when the loop by its formula does") {
  const test::CaptureExample example;
  CaptureGrid grid;
  grid.x_state = kStateTheta;
  grid.y_state = kStateW;
  grid.x = {-0.1, 0.1, 1.5, 3.4, 3.6};
  grid.y = {-0.001, 0.001, 0.5};
  constexpr int kPhases = 3;
  constexpr std::size_t kMost = 400;
  const SimulatedStarts found = simulate_starts(example.problem, grid, kPhases, kMost);
  REQUIRE(found.locked.size() == grid.cells());
  std::size_t longest = 0;
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    for (std::size_t column = 0; column < grid.columns(); ++column) {
      const std::size_t cell = grid.cell(column, row);
      CAPTURE(cell);
      int locked = 0;
      std::size_t latest = 0;
      for (int j = 0; j < kPhases; ++j) {
        const long double phase = 2.0L * std::numbers::pi_v<long double> * j / kPhases;
        test::CaptureExample::State state =
            example.start(static_cast<double>(phase), 0.5 * (grid.y[row] + grid.y[row + 1]),
                          0.5 * (grid.x[column] + grid.x[column + 1]));
        for (std::size_t k = 0; k <= kMost; ++k) {
          const long double here = phase + static_cast<long double>(k) * 0.35;
          state = k > 0 ? example.next(state, here, 0.0) : state;
          if (k % 4 == 0 && example.level(state, here) <= example.problem.level) {
            ++locked;
            latest = std::max(latest, k);
            break;
          }
        }
      }
      CHECK(found.locked[cell] == locked);
      CHECK(found.samples[cell] == latest);
      CHECK(found.locks(cell) == (locked == kPhases));
      longest = locked == kPhases ? std::max(longest, latest) : longest;
    }
  }
  CHECK(found.longest == longest);
  CHECK(longest > 0);
  CHECK(found.locks(grid.cell(0, 0)));
  CHECK_FALSE(found.locks(grid.cell(0, 1)));  // 0.25 rad/sample off
}

}  // namespace
}  // namespace veritrack::model
