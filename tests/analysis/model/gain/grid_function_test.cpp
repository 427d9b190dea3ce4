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

TEST_CASE(
    "a function is within its error of the lines through its points, along the phase and the frequency") {
  const rigor::BallModelScope scope(0, 0);
  for (const std::size_t phases : {16U, 64U}) {
    const double shift = 0.2 / static_cast<double>(phases);
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
    double from_flat = 0.0;
    const model::GridFunction flat = model::without_lean(f);
    for (int i = 0; i < 5000; ++i) {
      const double phase = 2.0 * std::numbers::pi * i / 5000.0;
      const auto g = static_cast<std::size_t>(phase / step) % phases;
      const double share = phase / step - std::floor(phase / step);
      const auto line = [&](const model::GridFunction& of, std::size_t end) {
        return (1.0 - share) * of.values[end][0][g] + share * of.values[end][0][(g + 1) % phases];
      };
      for (const double z : {-1.0, -0.3, 0.0, 1.0}) {
        const double value = wave(phase, shift * z);
        farthest = std::max(farthest,
                            std::fabs(value - 0.5 * (1.0 - z) * line(f, 0) - 0.5 * (1.0 + z) * line(f, 1)));
        from_flat = std::max(from_flat, std::fabs(value - line(flat, 0)));
      }
      CHECK(flat.values[0] == flat.values[1]);
    }
    CHECK(farthest <= f.error[0]);
    CHECK(f.error[0] < 3.0 * farthest);
    CHECK(from_flat <= flat.error[0]);
    CHECK(flat.error[0] < 1.5 * from_flat);
    CHECK(f.first_difference[0] < 1.9 * step + 0.02);
    CHECK(f.lean[0] == doctest::Approx(shift).epsilon(0.02));
    CHECK(f.lean_difference[0] <= shift * step * 1.01);
    CHECK(flat.lean[0] == 0.0);
  }
}

TEST_CASE("the distance of a model from a line in the frequency") {
  const rigor::BallModelScope scope(0, 0);
  const model::CellPlace place = model::place_of({0.1, 0.01, 0.0, 1.0});
  const BallModel f = BallModel(2.0) + BallModel(0.5) * place.z + BallModel(0.25) * place.z * place.z;
  CHECK(model::distance_from_line(f, 2.0, 0.5) == doctest::Approx(0.25));
  CHECK(model::distance_from_line(f, 1.9, 0.5) == doctest::Approx(0.35));
  CHECK(model::distance_from_line(f, 2.0, 0.2) == doctest::Approx(0.55));
  CHECK_FALSE(model::distance_from_line(BallModel(rigor::Interval::empty()), 0.0, 0.0) < INFINITY);
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
