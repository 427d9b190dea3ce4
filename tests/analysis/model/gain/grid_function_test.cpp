#include "analysis/model/gain/grid_function.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "analysis/model/step/tube_models.hpp"
#include "analysis/rigor/elementary.hpp"

namespace veritrack {

namespace {

using rigor::BallModel;

/// cos(phi + shift z) + 0.3 sin 3 phi.
double wave(double phase, double shift) {
  return std::cos(phase + shift) + 0.3 * std::sin(3.0 * phase);
}

}  // namespace

TEST_CASE("a function of the phase is within its error of the polygon through its points") {
  const rigor::BallModelScope scope(0, 0);
  for (const std::size_t phases : {16U, 64U}) {
    const double shift = 0.01;
    std::vector<BallModel> cells;
    for (std::size_t g = 0; g < phases; ++g) {
      const double half = 0.5 / static_cast<double>(phases);
      const model::CellPlace place = model::place_of({static_cast<double>(2 * g + 1) * half, half, 0.0, 1.0});
      cells.push_back(cos(place.phase + BallModel(shift) * place.z) +
                      BallModel(0.3) * sin(BallModel(3.0) * place.phase));
    }
    const model::GridFunction f = model::grid_function(
        1, phases, [&](std::size_t g, std::size_t) -> const BallModel& { return cells[g]; });
    const double step = 2.0 * std::numbers::pi / static_cast<double>(phases);
    double farthest = 0.0;
    for (int i = 0; i < 5000; ++i) {
      const double phase = 2.0 * std::numbers::pi * i / 5000.0;
      const auto g = static_cast<std::size_t>(phase / step) % phases;
      const double share = phase / step - std::floor(phase / step);
      const double polygon = (1.0 - share) * f.values[0][g] + share * f.values[0][(g + 1) % phases];
      for (const double z : {-1.0, 0.0, 1.0}) {
        farthest = std::max(farthest, std::fabs(wave(phase, shift * z) - polygon));
      }
    }
    CHECK(farthest <= f.error[0]);
    CHECK(f.error[0] < 3.0 * farthest);
    CHECK(f.first_difference[0] < 1.9 * step + 0.02);
  }
}

TEST_CASE("an unknown model has an error that bounds nothing") {
  const rigor::BallModelScope scope(0, 0);
  const BallModel known(1.0), unknown(rigor::Interval::empty());
  for (const auto& cells : {std::vector{known, unknown, known}, std::vector{unknown, known, known},
                            std::vector{known, known, unknown}}) {
    const model::GridFunction f =
        model::grid_function(1, 3, [&](std::size_t g, std::size_t) -> const BallModel& { return cells[g]; });
    CHECK_FALSE(f.error[0] < INFINITY);
  }
}

}  // namespace veritrack
