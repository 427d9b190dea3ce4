#include "analysis/model/step/cell_cover.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace veritrack::model {
namespace {

using rigor::Interval;

CellAnswer answer(bool is_proved, const Interval& range = Interval(0.0)) {
  CellAnswer result;
  result.is_proved = is_proved;
  result.range = range;
  return result;
}

/// Whether the cell is the middle of one, without a width.
bool is_point(const TubeCell& cell) {
  return cell.half_turn == 0.0 && cell.half_z == 0.0;
}

TEST_CASE("the cells that were proved cover a turn and [-1, 1] exactly") {
  std::mutex mutex;
  std::vector<TubeCell> proved;
  const auto ask = [&](const TubeCell& cell) {
    // Small cells near a place, large ones elsewhere; phase and frequency in turns.
    const double size = std::max(cell.half_turn, 0.5 * cell.half_z);
    const double distance = std::fabs(cell.turn - 0.3) + std::fabs(cell.z + 0.2);
    CellAnswer result = answer(is_point(cell) || size < 0.02 + 0.2 * distance, Interval(cell.z));
    result.by_phase = cell.half_turn;
    result.by_frequency = 0.5 * cell.half_z;
    if (result.is_proved && !is_point(cell)) {
      const std::scoped_lock lock(mutex);
      proved.push_back(cell);
    }
    return result;
  };
  const CoverResult cover = cover_cells(ask, {8, 2, 20000});
  CHECK(cover.is_proved);
  CHECK(cover.cells == proved.size());
  double area = 0.0;  // dyadic: exact
  for (const TubeCell& cell : proved) {
    area += 2.0 * cell.half_turn * 2.0 * cell.half_z;
  }
  CHECK(area == 2.0);
  for (double turn = 0.003; turn < 1.0; turn += 0.0137) {
    for (double z = -0.999; z < 1.0; z += 0.0271) {
      int in = 0;
      for (const TubeCell& cell : proved) {
        in += std::fabs(turn - cell.turn) <= cell.half_turn && std::fabs(z - cell.z) <= cell.half_z ? 1 : 0;
      }
      CHECK(in >= 1);
    }
  }
  CHECK(cover.range.lower() <= -0.75);
  CHECK(cover.range.upper() >= 0.75);
}

TEST_CASE("a cell whose middle fails is not halved, and the first one is reported") {
  std::atomic<int> questions{0};
  const auto ask = [&](const TubeCell& cell) {
    ++questions;
    return answer(std::fabs(cell.turn - 0.40625) > 0.04);
  };
  const CoverResult cover = cover_cells(ask, {16, 1, 20000});
  CHECK_FALSE(cover.is_proved);
  CHECK(cover.failed.turn == 0.40625);
  CHECK(questions.load() <= 17);
}

TEST_CASE("what is never proved ends with the budget, and nothing is known of the whole") {
  const auto ask = [](const TubeCell& cell) { return answer(is_point(cell)); };
  const CoverResult cover = cover_cells(ask, {4, 1, 100});
  CHECK_FALSE(cover.is_proved);
  CHECK(cover.failed.half_turn < 0.125);
  CHECK_THROWS_AS((void)cover_cells(ask, {3, 1, 100}), std::invalid_argument);
  CHECK_THROWS_AS((void)cover_cells(ask, {4, 0, 100}), std::invalid_argument);
  CHECK_FALSE(is_grid({-4, 1, 100}));
  CHECK(is_grid({4, 1, 100}));
}

TEST_CASE("where it is not known which width makes a cell fail, both are halved") {
  const auto of_width = [](double phases, double frequencies) {
    return [=](const TubeCell& cell) {
      CellAnswer result = answer(cell.half_turn < phases && cell.half_z < frequencies);
      result.by_phase = result.by_frequency = std::nan("");
      return result;
    };
  };
  CHECK(cover_cells(of_width(0.3, 0.3), {4, 1, 20000}).is_proved);
  CHECK(cover_cells(of_width(0.02, 2.0), {4, 1, 20000}).is_proved);
  CHECK(cover_cells(of_width(0.01, 0.1), {4, 1, 20000}).is_proved);
}

}  // namespace
}  // namespace veritrack::model
