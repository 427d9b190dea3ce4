// Parts that are neighbours of each other: a frequency that moves from one to the next, and starts, written
// out sample by sample against their bounds.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "analysis/model/gain/phase_kernels.hpp"
#include "tests/analysis/model/lag_sums.hpp"

namespace veritrack::model {
namespace {

constexpr std::size_t kHorizon = 128;
constexpr double kPartWidth = 0.0005;

/// Parts whose columns and matrices differ by these shares from one to the next.
std::vector<PhasePart> neighbours(test::Random& random, std::size_t count, double of_columns,
                                  double of_matrices) {
  test::HandMade of;
  of.half_width = kPartWidth;
  of.error = 1e-4;
  of.off = 1e-3;
  const PhasePart first = test::hand_made_part(random, of);
  std::vector<PhasePart> parts;
  for (std::size_t p = 0; p < count; ++p) {
    PhasePart part = first;
    const double share = of_columns * static_cast<double>(p);
    part.frequency += 2.0 * kPartWidth * static_cast<double>(p);
    const auto scale = [&](GridFunction& f, double factor) {
      for (auto& end : f.values) {
        for (std::vector<double>& component : end) {
          for (double& each : component) {
            each *= factor;
          }
        }
      }
      f = test::completed(std::move(f));
    };
    for (GridFunction& each : part.forms) {
      scale(each, 1.0 + share);
    }
    scale(part.noise[0], 1.0 + share);
    scale(part.slew, 1.0 - share);
    for (auto& [input, column] : part.columns) {
      scale(column, 1.0 + share);
    }
    for (std::size_t i = 0; i < part.matrix.size(); ++i) {
      part.middle[i] *= 1.0 + of_matrices * static_cast<double>(p);
      part.matrix[i] =
          rigor::Interval::from_bounds(part.middle[i] - part.off[i], part.middle[i] + part.off[i]);
    }
    part.residual = {1e-4 * static_cast<double>(p), 0.0};
    parts.push_back(std::move(part));
  }
  return parts;
}

const PhasePart& part_at(const std::vector<PhasePart>& parts, double frequency) {
  const double place = (frequency - parts.front().frequency) / (2.0 * kPartWidth) + 0.5;
  return parts[std::min(static_cast<std::size_t>(std::max(place, 0.0)), parts.size() - 1)];
}

std::vector<PhaseKernels> kernels_of(const std::vector<PhasePart>& parts, double slew) {
  std::vector<PhaseKernels> kernels;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    kernels.emplace_back(parts, p, PhaseGridding{256, kHorizon, parts.size(), 0, 0, kHorizon}, slew);
  }
  const auto totals = PhaseKernels::totals_of(kernels);
  REQUIRE(totals);
  for (PhaseKernels& each : kernels) {
    each.find(*totals);
  }
  return kernels;
}

}  // namespace

TEST_CASE("sums over lags with a frequency that moves through parts are within their bounds") {
  const rigor::UpwardRounding upward;
  test::Random random(601);
  constexpr double kSlew = 1e-4;
  for (int network = 0; network < 4; ++network) {
    const bool has_columns = network % 2 == 0;
    const std::vector<PhasePart> parts =
        neighbours(random, 5, has_columns ? 0.1 : 0.0, has_columns ? 0.0 : 0.005);
    const std::vector<PhaseKernels> kernels = kernels_of(parts, kSlew);
    const double low = parts.front().frequency - kPartWidth;
    const double high = parts.back().frequency + kPartWidth;
    double reached = 0.0;
    for (std::int64_t trial = 0; trial < test::effort(300); ++trial) {
      test::HandSizes sizes(random, 256);
      sizes.slew = random.below(2) == 0 ? 0.0 : random.uniform();
      const std::size_t p = random.below(parts.size());
      const std::size_t g = random.below(256);
      const double begin = (static_cast<double>(g) + random.uniform()) * 2.0 * std::numbers::pi / 256.0;
      double frequency = parts[p].frequency + random.uniform(-kPartWidth, kPartWidth);
      const double direction = random.uniform(-1.0, 1.0) < 0.0 ? -kSlew : kSlew;
      const GridFunction& form = parts[p].forms[1];
      Eigen::RowVector2d row = test::grid_value(form, begin, 0.0, Eigen::RowVector2d::Zero()).transpose();
      double phase = begin;
      double sum = 0.0;
      for (int k = 0; k < 300; ++k) {
        // The sample before: its frequency, and the phase at which it begins.
        frequency = std::clamp(frequency + direction, low, high);
        phase -= frequency;
        const PhasePart& there = part_at(parts, frequency);
        sum += test::effect_of_sample(there, row, phase, 0.0, sizes);
        row = test::times_matrix(row, there, 0.0);
      }
      const double bound = test::kernel_bound(kernels[p], 1, g, sizes);
      REQUIRE(sum <= bound * (1.0 + 1e-12));
      reached = std::max(reached, sum / bound);
    }
    CHECK(reached > 0.55);
  }
}

TEST_CASE("what starts leave is within its bounds, from every block on") {
  const rigor::UpwardRounding upward;
  test::Random random(602);
  for (std::int64_t trial = 0; trial < test::effort(20); ++trial) {
    std::vector<PhasePart> parts = neighbours(random, 1, 0.0, 0.0);
    // Powers that grow at first.
    parts[0].middle = {0.9, 0.5, 0.0, 0.9};
    for (std::size_t i = 0; i < 4; ++i) {
      parts[0].matrix[i] = rigor::Interval(parts[0].middle[i]) +
                           rigor::Interval::from_bounds(-parts[0].off[i], parts[0].off[i]);
    }
    const std::vector<PhaseKernels> kernels = kernels_of(parts, 0.0);
    const std::vector<double> start{random.uniform(), random.uniform()};
    const auto peak = PhaseKernels::peak_of(kernels, start);
    REQUIRE(peak);
    std::vector<double> bounds;
    for (std::size_t block = 0; block <= PhaseKernels::kBlocks; ++block) {
      bounds.push_back(kernels[0].from_start(start, *peak, block)[0]);
    }
    double most = 0.0;
    for (int place = 0; place < 32; ++place) {
      const double phase = random.uniform(0.0, 6.28);
      Eigen::RowVector2d row =
          test::grid_value(parts[0].forms[0], phase, 0.0, Eigen::RowVector2d::Zero()).transpose();
      for (std::size_t k = 0; k < 2 * kHorizon; ++k) {
        const double seen = std::fabs(row(0)) * start[0] + std::fabs(row(1)) * start[1];
        const std::size_t block = std::min(k * PhaseKernels::kBlocks / kHorizon, PhaseKernels::kBlocks);
        for (const std::size_t before : {std::size_t{0}, block / 2, block}) {
          REQUIRE(seen <= bounds[before] * (1.0 + 1e-12));
        }
        most = std::max(most, seen);
        row = test::times_matrix(row, parts[0], 0.0);
      }
    }
    CHECK(most > 0.4 * bounds[0]);
    CHECK(bounds[PhaseKernels::kBlocks / 2] < 0.1 * bounds[0]);
  }
}

TEST_CASE("powers that do not decay within the horizon have no totals") {
  const rigor::UpwardRounding upward;
  test::Random random(603);
  test::HandMade of;
  for (const double decay : {0.9, 0.99, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    of.decay = decay;
    const std::vector<PhasePart> parts{test::hand_made_part(random, of)};
    std::vector<PhaseKernels> kernels;
    kernels.emplace_back(parts, 0, PhaseGridding{256, kHorizon}, 0.0);
    CHECK(PhaseKernels::totals_of(kernels).has_value() == (decay < 1.0));
  }
  CHECK_FALSE(PhaseKernels::totals_of({}));
}

}  // namespace veritrack::model
