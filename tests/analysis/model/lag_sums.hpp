// Sums over lags, written out, and the bounds of them that kernels give.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "analysis/model/gain/phase_kernels.hpp"
#include "tests/analysis/model/hand_made_part.hpp"
#include "tests/support/random.hpp"

namespace veritrack::test {

/// The sizes of the inputs: of the noise, of both gates by cells of phases.
struct HandSizes {
  double noise = 0.0, slew = 0.0;
  std::vector<double> gates[2];

  HandSizes(Random& random, std::size_t phases) {
    const auto any = [&] { return random.below(3) == 0 ? 0.0 : random.uniform(); };
    noise = any();
    for (std::vector<double>& each : gates) {
      const double most = any();
      const std::uint64_t few = 1 + random.below(4);
      for (std::size_t g = 0; g < phases; ++g) {
        each.push_back(random.below(few) == 0 ? most * random.uniform() : 0.0);
      }
    }
  }
};

/// What the inputs of one sample at this phase do, at most, where `row` is what is seen of them.
inline double effect_of_sample(const model::PhasePart& part, const Eigen::RowVector2d& row, double phase,
                               double t, const HandSizes& sizes) {
  double squares = 0.0;
  for (const model::GridFunction& each : part.noise) {
    const double seen = row.dot(grid_value(each, phase, t, row));
    squares += seen * seen;
  }
  double sum = sizes.noise * std::sqrt(squares);
  sum += sizes.slew * std::fabs(row.dot(grid_value(part.slew, phase, t, row)));
  sum += std::fabs(row(0)) * part.residual[0] + std::fabs(row(1)) * part.residual[1];
  const double turns = phase / (2.0 * std::numbers::pi);
  const std::size_t phases = sizes.gates[0].size();
  const auto cell =
      static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(phases)) % phases;
  std::size_t q = 0;
  for (const auto& [input, column] : part.columns) {
    sum += sizes.gates[q++][cell] * std::fabs(row.dot(grid_value(column, phase, t, row)));
  }
  return sum;
}

/// The bound of docs/gain-proof.md, section 10, in the cell g, without direct terms.
inline double kernel_bound(const model::PhaseKernels& kernels, std::size_t form, std::size_t g,
                           const HandSizes& sizes) {
  using Kernels = model::PhaseKernels;
  const std::size_t phases = sizes.gates[0].size();
  double sum = kernels.residual(form) + kernels.missed(form, Kernels::kNoise) * sizes.noise +
               kernels.missed(form, Kernels::kSlew) * sizes.slew;
  double most = 0.0;
  for (std::size_t q = 0; q < 2; ++q) {
    sum += kernels.missed(form, Kernels::kFirstGate + q) *
           *std::max_element(sizes.gates[q].begin(), sizes.gates[q].end());
  }
  for (const std::size_t point : {g, (g + 1) % phases}) {
    double here = kernels.gain(form, Kernels::kNoise, point) * sizes.noise +
                  kernels.gain(form, Kernels::kSlew, point) * sizes.slew;
    for (std::size_t q = 0; q < 2; ++q) {
      const double* gains = kernels.gains(form, Kernels::kFirstGate + q, point);
      for (std::size_t w = 0; w < kernels.windows().size(); ++w) {
        const Kernels::Window& window = kernels.windows()[w];
        double largest = 0.0;
        for (std::size_t i = 0; i < std::min(phases, std::size_t{1} << window.exponent); ++i) {
          largest = std::max(largest, sizes.gates[q][(g + window.offset + i) % phases]);
        }
        here += gains[w] * largest;
      }
      if (kernels.has_late()) {
        const std::vector<double> late = kernels.late_sizes(sizes.gates[q]);
        for (std::size_t j = 0; j < phases; ++j) {
          here += kernels.late(form, Kernels::kFirstGate + q, point)[j] * late[j];
        }
      }
    }
    most = std::max(most, here);
  }
  return sum + most;
}

/// The sum over all lags of what inputs do to the form at a phase, at one frequency.
inline double sum_over_lags(const model::PhasePart& part, const model::GridFunction& form, double phase,
                            double t, const HandSizes& sizes, int lags) {
  const double frequency = part.frequency + t * part.half_width;
  const Eigen::RowVector2d plain = grid_value(form, phase, t, Eigen::RowVector2d::Zero()).transpose();
  Eigen::RowVector2d row = grid_value(form, phase, t, plain).transpose();
  double sum = 0.0;
  for (int k = 0; k < lags; ++k) {
    sum += effect_of_sample(part, row, phase - (k + 1) * frequency, t, sizes);
    row = times_matrix(row, part, t);
  }
  return sum;
}

/// Attacks the bounds of random parts; the largest share that is reached.
inline double attack_sums(const HandMade& of, const model::PhaseGridding& gridding, std::uint64_t stream,
                          int networks = 4, std::int64_t trials = 40) {
  Random random(stream);
  double reached = 0.0;
  for (int network = 0; network < networks; ++network) {
    const std::vector<model::PhasePart> parts{hand_made_part(random, of)};
    std::vector<model::PhaseKernels> kernels;
    kernels.emplace_back(parts, 0, gridding, 0.0);
    const auto totals = model::PhaseKernels::totals_of(kernels);
    REQUIRE(totals);
    kernels[0].find(*totals);
    for (std::int64_t trial = 0; trial < effort(trials); ++trial) {
      const HandSizes sizes(random, of.phases);
      const double t = random.below(2) == 0 ? 1.0 : random.uniform(-1.0, 1.0);
      const std::size_t g = random.below(of.phases);
      const double share = random.below(2) == 0 ? 0.0 : random.uniform();
      const double phase =
          (static_cast<double>(g) + share) * 2.0 * std::numbers::pi / static_cast<double>(of.phases);
      const std::size_t form = random.below(2);
      const double sum =
          sum_over_lags(parts[0], parts[0].forms[form], phase, t, sizes, 2 * static_cast<int>(gridding.lags));
      const double bound = kernel_bound(kernels[0], form, g, sizes);
      REQUIRE(sum <= bound * (1.0 + 1e-12));
      reached = std::max(reached, sum / bound);
    }
  }
  return reached;
}

}  // namespace veritrack::test
