#include "analysis/model/map/capture_basin.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;
/// Samples between two looks at the level.
constexpr std::size_t kLookEvery = 4;

/// The number of samples after which a start is in the tube; empty when it is not within `most`.
std::optional<std::size_t> samples_to_lock(const CaptureProblem& problem, const PointTube& tube,
                                           PointTracker& points, Eigen::VectorXd state, double phase,
                                           std::size_t most) {
  const double frequency = 0.5 * (problem.frequency.lower() + problem.frequency.upper());
  PointFrame frame;
  for (std::size_t k = 0;; ++k) {
    const double here = std::remainder(phase + static_cast<double>(k) * frequency, kWholeTurn);
    if (k % kLookEvery == 0) {
      tube.at(here, frame);
      Eigen::VectorXd near = state;
      for (Eigen::Index i = 0; i < near.size(); ++i) {
        if (problem.tracker->recursion->is_angle[static_cast<std::size_t>(i)]) {
          near[i] -= kWholeTurn * std::round((near[i] - frame.curve[i]) / kWholeTurn);
        }
      }
      const double level = frame.coordinates(near).norm();
      if (level <= problem.level) {
        return k;
      }
      constexpr double kLost = 1e12;
      if (!(level < kLost * problem.level) || k >= most) {
        return std::nullopt;
      }
    }
    state = points.next(state, points.samples(here + frequency));
  }
}

}  // namespace

SimulatedStarts simulate_starts(const CaptureProblem& problem, const CaptureGrid& grid, int phases,
                                std::size_t most_samples) {
  SimulatedStarts result{phases, std::vector<int>(grid.cells(), 0), std::vector<std::size_t>(grid.cells(), 0),
                         0};
  const double frequency = 0.5 * (problem.frequency.lower() + problem.frequency.upper());
  tbb::parallel_for(std::size_t{0}, grid.cells(), [&](std::size_t cell) {
    const rigor::NearestRounding nearest;
    const std::size_t column = cell % grid.columns();
    const std::size_t row = cell / grid.columns();
    const PointTube tube(*problem.tube, frequency);
    PointTracker points(*problem.tracker);
    PointFrame frame;
    for (int j = 0; j < phases; ++j) {
      const double phase = kWholeTurn * j / phases;
      tube.at(phase, frame);
      Eigen::VectorXd state = frame.curve;
      state[static_cast<Eigen::Index>(grid.x_state)] += 0.5 * (grid.x[column] + grid.x[column + 1]);
      state[static_cast<Eigen::Index>(grid.y_state)] += 0.5 * (grid.y[row] + grid.y[row + 1]);
      if (const auto samples = samples_to_lock(problem, tube, points, state, phase, most_samples)) {
        ++result.locked[cell];
        result.samples[cell] = std::max(result.samples[cell], *samples);
      }
    }
  });
  for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
    result.longest = result.locks(cell) ? std::max(result.longest, result.samples[cell]) : result.longest;
  }
  return result;
}

std::vector<std::array<double, 2>> edge_of_section(const CaptureProblem& problem, std::size_t x_state,
                                                   double x_unit, std::size_t y_state, double y_unit,
                                                   int count) {
  const rigor::NearestRounding nearest;
  constexpr int kPhases = 64;
  const PointTube tube(*problem.tube, 0.5 * (problem.frequency.lower() + problem.frequency.upper()));
  std::vector<PointFrame> frames(kPhases);
  for (int j = 0; j < kPhases; ++j) {
    tube.at(kWholeTurn * j / kPhases, frames[static_cast<std::size_t>(j)]);
  }
  std::vector<std::array<double, 2>> edge;
  edge.reserve(static_cast<std::size_t>(count) + 1);
  for (int i = 0; i <= count; ++i) {
    const double angle = kWholeTurn * (i % count) / count;
    const double x = x_unit * std::cos(angle);
    const double y = y_unit * std::sin(angle);
    double level = 0.0;
    for (const PointFrame& frame : frames) {
      Eigen::VectorXd state = frame.curve;
      state[static_cast<Eigen::Index>(x_state)] += x;
      state[static_cast<Eigen::Index>(y_state)] += y;
      level = std::max(level, frame.coordinates(state).norm());
    }
    const double scale = level > 0.0 ? problem.level / level : 0.0;
    edge.push_back({x * scale, y * scale});
  }
  return edge;
}

}  // namespace veritrack::model
