// A loop and a basis over the phase at points, in floating point: what one sample does to errors.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "analysis/model/gain/phase_part.hpp"
#include "tests/analysis/model/tube_examples.hpp"
#include "tests/support/oracles.hpp"
#include "tests/support/random.hpp"

namespace veritrack::test {

/// X = C + P eta at a phase and a frequency.
class FloquetPoints {
 public:
  FloquetPoints(const ExampleTracker& tracker, const model::FloquetCell& cell)
      : tracker_(&tracker), cell_(&cell) {}

  [[nodiscard]] Eigen::VectorXd curve(double phase, double frequency) const {
    return PointTube(cell_->curve).curve(phase, frequency);
  }
  [[nodiscard]] Eigen::MatrixXd basis(double phase, double frequency) const {
    const auto n = static_cast<Eigen::Index>(cell_->states());
    model::Tube rows;
    rows.frequency = cell_->curve.frequency;
    rows.half_width = cell_->curve.half_width;
    rows.turns.assign(cell_->basis.size(), 0);
    rows.curve = cell_->basis;
    const Eigen::VectorXd entries = PointTube(rows).curve(phase, frequency);
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        matrix(i, j) = entries(i * n + j);
      }
    }
    return matrix;
  }
  /// cos, and with two channels sin.
  [[nodiscard]] Eigen::VectorXd samples(double phase) const {
    Eigen::VectorXd result(tracker_->recursion.samples);
    for (Eigen::Index c = 0; c < result.size(); ++c) {
      result(c) = c == 0 ? std::cos(phase) : std::sin(phase);
    }
    return result;
  }
  /// The errors after a sample at phase + frequency with this noise, in the basis at that phase and the
  /// frequency `next`.
  [[nodiscard]] Eigen::VectorXd after(double phase, double frequency, double next, const Eigen::VectorXd& eta,
                                      const Eigen::VectorXd& noise) const {
    const Eigen::VectorXd state = curve(phase, frequency) + basis(phase, frequency) * eta;
    const double later = phase + frequency;
    const Eigen::VectorXd moved = next_of(state, samples(later) + noise);
    return oracle::solution(basis(later, next), moved - curve(later, next));
  }
  /// Its derivatives by eta and the noise, by central differences.
  [[nodiscard]] Eigen::MatrixXd slopes(double phase, double frequency) const {
    constexpr double kStep = 1e-5;
    const auto n = static_cast<Eigen::Index>(cell_->states());
    const Eigen::Index all = n + tracker_->recursion.samples;
    Eigen::MatrixXd result(n, all);
    for (Eigen::Index j = 0; j < all; ++j) {
      const Eigen::VectorXd unit = kStep * Eigen::VectorXd::Unit(all, j);
      result.col(j) = (after(phase, frequency, frequency, unit.head(n), unit.tail(all - n)) -
                       after(phase, frequency, frequency, -unit.head(n), -unit.tail(all - n))) /
                      (2.0 * kStep);
    }
    return result;
  }
  [[nodiscard]] double frequency_of(const Eigen::VectorXd& state) const {
    return run(tracker_->recursion.frequency, state, Eigen::VectorXd())(0);
  }

 private:
  [[nodiscard]] Eigen::VectorXd next_of(const Eigen::VectorXd& state, const Eigen::VectorXd& samples) const {
    return run(tracker_->recursion.step, state, samples);
  }
  [[nodiscard]] Eigen::VectorXd run(const StraightLineProgram& program, const Eigen::VectorXd& state,
                                    const Eigen::VectorXd& samples) const {
    std::vector<double> inputs = tracker_->constants;
    inputs.insert(inputs.end(), state.begin(), state.end());
    inputs.insert(inputs.end(), samples.begin(), samples.end());
    std::vector<double> registers;
    std::vector<double> results(program.results().size());
    program.run(std::span<const double>(inputs), registers, std::span(results));
    return Eigen::Map<const Eigen::VectorXd>(results.data(), static_cast<Eigen::Index>(results.size()));
  }

  const ExampleTracker* tracker_;
  const model::FloquetCell* cell_;
};

/// A cell that is no steady state and whose basis makes nothing constant: what is enclosed has to be enclosed
/// all the same. The first harmonics change by at most this share of the largest.
inline model::FloquetCell disturbed(model::FloquetCell cell, double share, Random& random) {
  constexpr std::size_t kHarmonics = 3;
  const auto disturb = [&](model::PhaseSeries& series) {
    double size = 0.0;
    for (const auto& of_harmonic : series.coefficients) {
      for (const std::complex<double>& each : of_harmonic) {
        size = std::max(size, std::abs(each));
      }
    }
    for (std::size_t h = 0; h < std::min(kHarmonics, series.coefficients.size()); ++h) {
      for (std::complex<double>& each : series.coefficients[h]) {
        const double real = random.uniform(-share, share);
        each += size * std::complex<double>(real, random.uniform(-share, share));
      }
    }
  };
  for (model::PhaseSeries& each : cell.curve.curve) {
    disturb(each);
  }
  for (model::PhaseSeries& each : cell.basis) {
    disturb(each);
  }
  for (std::vector<double>& entry : cell.matrix) {
    for (double& each : entry) {
      each += share * random.uniform(-1.0, 1.0);
    }
  }
  return cell;
}

inline Eigen::VectorXd random_vector(Random& random, Eigen::Index size, double largest) {
  Eigen::VectorXd result(size);
  for (double& each : result) {
    each = largest * random.uniform(-1.0, 1.0);
  }
  return result;
}

/// A phase and a frequency of a part.
struct PartPlace {
  double phase, frequency, t, share;
  std::size_t cell, next;

  PartPlace(const model::PhasePart& part, Random& random) {
    const auto count = static_cast<double>(part.cells.size());
    cell = random.below(part.cells.size());
    next = (cell + 1) % part.cells.size();
    share = random.uniform();
    t = random.below(4) == 0 ? 1.0 : random.uniform(-1.0, 1.0);
    phase = (static_cast<double>(cell) + share) * 2.0 * std::numbers::pi / count;
    frequency = part.frequency + t * part.half_width;
  }
  /// Between the points of the grid and the ends of the part.
  [[nodiscard]] double line(const model::GridFunction& f, std::size_t i) const {
    const auto at_end = [&](std::size_t end) {
      return (1.0 - share) * f.values[end][i][cell] + share * f.values[end][i][next];
    };
    return 0.5 * (1.0 - t) * at_end(0) + 0.5 * (1.0 + t) * at_end(1);
  }
};

/// The sizes of the inputs of a part at a place, where forms are what they are there.
inline std::vector<double> part_sizes(const model::PhasePart& part, const PartPlace& place,
                                      const Eigen::VectorXd& eta, const Eigen::VectorXd& noise) {
  const model::PhaseNetwork& cell = part.cells[place.cell];
  std::vector<double> sizes(cell.inputs.size(), 0.0);
  for (std::size_t round = 0; round <= sizes.size(); ++round) {
    std::vector<double> bounds;
    for (std::size_t f = 0; f < part.forms.size(); ++f) {
      double sum = 0.0;
      double more = 0.0;
      for (std::size_t j = 0; j < part.states; ++j) {
        const double error = eta(static_cast<Eigen::Index>(j));
        sum += place.line(part.forms[f], j) * error;
        more += part.forms[f].error[j] * std::fabs(error);
      }
      for (const model::DirectWeight& each : cell.direct[f]) {
        more += each.weight * sizes[static_cast<std::size_t>(each.input)];
      }
      bounds.push_back(std::fabs(sum) + more);
    }
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const model::PhaseInput& input = cell.inputs[i];
      double sum = 0.0;
      for (const model::DirectWeight& each : input.sources) {
        sum += each.weight * sizes[static_cast<std::size_t>(each.input)];
      }
      sizes[i] = input.is_noise ? std::fabs(noise(static_cast<Eigen::Index>(i)))
                 : input.size   ? input.size(bounds)
                                : sum;
    }
  }
  return sizes;
}

}  // namespace veritrack::test
