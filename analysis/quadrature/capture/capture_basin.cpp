#include "analysis/quadrature/capture/capture_basin.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/rigor/rounding.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;
using rigor::Verdict;

constexpr double kLockedWithin = 1e-3;  // rad/sample

struct Run {
  trackers::ToneModel<double> design;
  rigor::Matrix<3> initial_covariance;
  double frequency = 0.0;
  int samples = 0;

  /// The frequency error, rad/sample, that the tracker ends with on the signal e^{i omega k}.
  [[nodiscard]] double final_frequency_error(double amplitude_error, double phase_error,
                                             double frequency_error) const {
    const rigor::NearestRounding nearest;
    const double cosine = std::cos(phase_error);
    const double sine = std::sin(phase_error);
    rigor::Matrix<3> turn = rigor::Matrix<3>::Identity();
    turn.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
    trackers::QuadratureEkf<double> tracker(
        design,
        {(1.0 + amplitude_error) * cosine, (1.0 + amplitude_error) * sine, frequency + frequency_error,
         trackers::FactoredCovariance<double>::from_matrix(turn * initial_covariance * turn.transpose())});
    for (int k = 1; k <= samples; ++k) {
      const double phase = std::remainder(frequency * k, 2.0 * std::numbers::pi);
      tracker.step(std::cos(phase), std::sin(phase));
    }
    return tracker.filtered().frequency - frequency;
  }
};

double grid_point(const Interval& range, int index, int count) {
  return range.lower() + (range.upper() - range.lower()) * ((index + 0.5) / count);
}

}  // namespace

double SimulatedBasin::phase(int index) const {
  return grid_point(phase_error, index, phases);
}

double SimulatedBasin::frequency(int index) const {
  return grid_point(frequency_error, index, frequencies);
}

bool SimulatedBasin::locks_at(int phase_index, int frequency_index) const {
  return locks[static_cast<std::size_t>(phase_index * frequencies + frequency_index)] != 0;
}

SimulatedBasin simulate_basin(const CaptureProblem& problem, const StartBox& starts, int phases,
                              int frequencies, int samples) {
  const bool finite =
      is_finite(starts.amplitude_error) && is_finite(starts.phase_error) && is_finite(starts.frequency_error);
  if (!finite || phases <= 0 || frequencies <= 0 || samples <= 0) {
    throw std::invalid_argument("simulated basin: the starts must be finite and the numbers positive");
  }
  const Run run{{midpoint(problem.design.q1), midpoint(problem.design.q2), midpoint(problem.design.r),
                 midpoint(problem.design.epsilon)},
                rigor::midpoint(problem.initial_covariance),
                midpoint(problem.frequency),
                samples};
  const double amplitude_error = midpoint(starts.amplitude_error);
  const double lock = run.design.without_leak() ? 0.0 : run.final_frequency_error(0.0, 0.0, 0.0);
  SimulatedBasin basin{starts.phase_error, starts.frequency_error, phases, frequencies, {}};
  basin.locks.resize(static_cast<std::size_t>(phases) * static_cast<std::size_t>(frequencies));
  tbb::parallel_for(0, phases, [&](int i) {
    for (int j = 0; j < frequencies; ++j) {
      const double end = run.final_frequency_error(amplitude_error, basin.phase(i), basin.frequency(j));
      basin.locks[static_cast<std::size_t>(i * frequencies + j)] =
          std::fabs(end - lock) < kLockedWithin ? 1 : 0;
    }
  });
  return basin;
}

BasinShares shares_of_basin(const Region& region, const SimulatedBasin& basin) {
  // 0: in no cell, 1: proved, 2: refuted, 3: undecided; the largest that touches the point.
  std::vector<int> worst(basin.locks.size(), 0);
  for (const RegionCell& cell : region.cells) {
    const int level = cell.verdict == Verdict::proved ? 1 : cell.verdict == Verdict::refuted ? 2 : 3;
    for (int i = 0; i < basin.phases; ++i) {
      if (!contains(cell.starts.phase_error, basin.phase(i))) {
        continue;
      }
      for (int j = 0; j < basin.frequencies; ++j) {
        int& entry = worst[static_cast<std::size_t>(i * basin.frequencies + j)];
        if (contains(cell.starts.frequency_error, basin.frequency(j))) {
          entry = std::max(entry, level);
        }
      }
    }
  }
  BasinShares shares;
  for (std::size_t k = 0; k < worst.size(); ++k) {
    if (basin.locks[k] != 0) {
      ++shares.points;
      (worst[k] == 1 ? shares.proved : worst[k] == 2 ? shares.refuted : shares.undecided) += 1.0;
    }
  }
  const double points = static_cast<double>(shares.points);
  if (shares.points > 0) {
    shares.proved /= points;
    shares.refuted /= points;
    shares.undecided /= points;
  }
  return shares;
}

}  // namespace veritrack::quadrature
