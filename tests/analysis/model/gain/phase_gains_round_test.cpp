// Rounds of bounds that are resolved over the phases, of loops with one state: against the fixed point on
// paper, and against sums over lags that are written out.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/model/gain/phase_gains.hpp"
#include "tests/analysis/model/hand_made_part.hpp"
#include "tests/support/random.hpp"

namespace veritrack::model {
namespace {

constexpr double kRoundOmega = 0.5;

GridFunction constant_function(std::size_t phases, double value) {
  GridFunction f;
  f.values[0] = f.values[1] = {std::vector<double>(phases, value)};
  f.error = {0.0};
  return test::completed(std::move(f));
}

/// eta' = decay eta + v + a remainder; the frequency error is eta and no other form. Input 0 is noise, input
/// 1 the remainder, of size `size` by cell and bounds.
PhasePart one_state_part(std::size_t phases, double decay,
                         const std::function<double(std::size_t cell, double bound)>& size) {
  PhasePart part;
  part.states = 1;
  part.frequency = kRoundOmega;
  part.half_width = 1e-9;
  part.forms.push_back(constant_function(phases, 1.0));
  part.noise.push_back(constant_function(phases, 1.0));
  part.columns.emplace(1, constant_function(phases, 1.0));
  part.slew = constant_function(phases, 0.0);
  part.middle = {decay};
  part.matrix = {rigor::Interval(decay)};
  part.inverse = {1.0};
  part.slew_bend = part.lean = part.off = part.residual = part.basis_slope = part.basis_bend = {0.0};
  for (std::size_t g = 0; g < phases; ++g) {
    PhaseNetwork cell;
    cell.inputs.push_back({true, {}, {}});
    cell.inputs.push_back(
        {false, [size, g](const std::vector<double>& bounds) { return size(g, bounds[0]); }, {}});
    cell.direct.resize(1);
    cell.bias = cell.mean_bias = rigor::Interval(0.0);
    part.cells.push_back(std::move(cell));
  }
  return part;
}

std::optional<PhaseGains> gains_with(std::vector<PhasePart> parts, double slew = 0.0) {
  const std::size_t phases = parts.front().cells.size();
  return PhaseGains::make(std::move(parts), {phases, 512, 1, 0, 0, 512}, slew);
}

TEST_CASE("a remainder that grows as the square of the bound: the least fixed point, and none beyond it") {
  const rigor::UpwardRounding upward;
  constexpr double kDecay = 0.9;
  constexpr double kMost = 0.25 * (1.0 - kDecay) * (1.0 - kDecay);  // Y = (V + Y^2)/(1 - a) has a solution
  const auto gains =
      gains_with({one_state_part(8, kDecay, [](std::size_t, double bound) { return bound * bound; })});
  REQUIRE(gains);
  for (const double share : {0.05, 0.5, 0.9, 0.96}) {
    CAPTURE(share);
    const double least = 0.5 * (1.0 - kDecay) * (1.0 - std::sqrt(1.0 - share));
    const auto errors = gains->errors({share * kMost, 0.0, {}});
    REQUIRE(errors);
    CHECK(errors->long_run >= least);
    CHECK(errors->long_run <= 1.01 * least);
    CHECK(errors->for_ever >= errors->long_run);
    CHECK(errors->for_ever <= 1.02 * least);
    CHECK(errors->linear == doctest::Approx(share * kMost / (1.0 - kDecay)).epsilon(1e-6));
  }
  CHECK_FALSE(gains->errors({1.01 * kMost, 0.0, {}}));
}

TEST_CASE("remainders without a size bound nothing") {
  const rigor::UpwardRounding upward;
  const auto are_bounded = [](double size) {
    const auto gains = gains_with(
        {one_state_part(8, 0.5, [size](std::size_t cell, double) { return cell == 3 ? size : 0.0; })});
    REQUIRE(gains);
    return gains->errors({0.1, 0.0, {}}).has_value();
  };
  CHECK(are_bounded(0.1));
  CHECK_FALSE(are_bounded(INFINITY));
  CHECK_FALSE(are_bounded(NAN));
}

TEST_CASE("inputs of some cells reach a cell after the samples that the phase needs") {
  const rigor::UpwardRounding upward;
  constexpr std::size_t kCells = 64;
  constexpr double kDecay = 0.6;
  test::Random random(971);
  for (std::int64_t trial = 0; trial < test::effort(40); ++trial) {
    std::vector<double> sizes(kCells, 0.0);
    for (std::uint64_t i = 0; i < 1 + random.below(6); ++i) {
      sizes[random.below(kCells)] = random.uniform();
    }
    const std::size_t target = random.below(kCells);
    PhasePart part = one_state_part(kCells, kDecay, [&](std::size_t cell, double) { return sizes[cell]; });
    part.cells[target].bias = rigor::Interval(100.0);  // this cell decides
    const auto gains = gains_with({std::move(part)});
    REQUIRE(gains);
    const auto errors = gains->errors({});
    REQUIRE(errors);
    const double bound = errors->for_ever - 100.0;
    const double cells_per_radian = kCells / (2.0 * std::numbers::pi);
    const auto sum = [&](double share, int around) {
      double result = 0.0;
      double power = 1.0;
      for (int k = 0; k < 60; ++k, power *= kDecay) {
        const double place = static_cast<double>(target) + share - (k + 1) * kRoundOmega * cells_per_radian;
        double most = 0.0;
        for (int d = -around; d <= around; ++d) {
          const auto cell = static_cast<int>(std::floor(place)) + d;
          most =
              std::max(most, sizes[static_cast<std::size_t>(cell + 100 * static_cast<int>(kCells)) % kCells]);
        }
        result += power * most;
      }
      return result;
    };
    for (const double share : {0.0, 0.25, 0.5, 0.999}) {
      REQUIRE(sum(share, 0) <= bound + 1e-12);
    }
    CHECK(bound <= 1.001 * sum(0.5, 4) + 1e-6);
  }
}

TEST_CASE("inputs that act through a gate, and in the same sample, add up by their weights") {
  const rigor::UpwardRounding upward;
  PhasePart part = one_state_part(8, 0.75, [](std::size_t, double) { return 0.3; });
  part.columns.clear();
  part.columns.emplace(2, constant_function(8, -2.0));
  for (PhaseNetwork& cell : part.cells) {
    cell.inputs.push_back({false, {}, {{0, 0.5}, {1, 2.0}}});  // 0.5 V + 0.6
    cell.direct[0] = {{0, 0.7}, {2, 0.25}};
  }
  const auto gains = gains_with({std::move(part)});
  REQUIRE(gains);
  constexpr double kNoise = 0.1;
  constexpr double kGate = 0.5 * kNoise + 2.0 * 0.3;
  const double expected = (kNoise + 2.0 * kGate) / (1.0 - 0.75) + 0.7 * kNoise + 0.25 * kGate;
  const auto errors = gains->errors({kNoise, 0.0, {}});
  REQUIRE(errors);
  CHECK(errors->long_run >= expected);
  CHECK(errors->long_run <= 1.001 * expected);
}

TEST_CASE("with a slew every part has the largest remainder of all parts") {
  const rigor::UpwardRounding upward;
  constexpr double kSlowest = 1e-300;
  const auto part_with = [](double size) {
    return one_state_part(8, 0.5, [size](std::size_t, double) { return size; });
  };
  PhasePart alone = part_with(0.1);
  PhasePart small = part_with(0.1);
  for (PhasePart* each : {&alone, &small}) {
    for (PhaseNetwork& cell : each->cells) {
      cell.bias = rigor::Interval(10.0);  // this part decides
    }
  }
  const auto of_one = gains_with({std::move(alone)}, kSlowest);
  const auto of_both = gains_with({std::move(small), part_with(0.4)}, kSlowest);
  REQUIRE(of_one);
  REQUIRE(of_both);
  CHECK(of_one->errors({})->long_run == doctest::Approx(10.0 + 0.1 / 0.5).epsilon(1e-3));
  CHECK(of_both->errors({})->long_run == doctest::Approx(10.0 + 0.4 / 0.5).epsilon(1e-3));
}

}  // namespace
}  // namespace veritrack::model
