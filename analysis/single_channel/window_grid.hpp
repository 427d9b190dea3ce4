// The samples behind proposals of windows: phases and frequencies of a grid, in floating point, several
// points at once (window_grid_lanes.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "analysis/single_channel/window_proposal.hpp"
#include "trackers/instruction_set.hpp"

namespace veritrack::single_channel::detail {

inline constexpr int kSettling = 16;
inline constexpr int kLongestWindow = 12;
inline constexpr int kGridPhases = 24;
inline constexpr int kGridFrequencies = 5;
inline constexpr int kGridPoints = kGridPhases * kGridFrequencies;
inline constexpr int kWeights = 10;  ///< of a curvature
inline constexpr int kParts = 9;     ///< of a start

/// The quantities followed at the points of a grid. Plain, for units for different processors.
struct GridTask {
  trackers::ToneModel<double> design;
  WindowAssumption assumption;
  WindowLength length;
  const double* sine = nullptr;  ///< of the phase, kGridPoints for each sample, the settling ones first
  const double* cosine = nullptr;
};

/// The largest variances of the upper bounds after the first sample of the window.
struct GridVariances {
  double signal = 0.0;
  double frequency = 0.0;
};

/// The results under the assumption, for windows of every length up to the longest.
struct GridView {
  double shares[kLongestWindow];                // NOLINT: plain
  double signal_uncertainties[kLongestWindow];  // NOLINT
  double curvatures[kWeights];                  ///< for each of the weights NOLINT
};

/// For each part t in {0.1, ..., 0.9} the least level whose square, times the covariances after the window,
/// is above diag(signal^2 / t, signal^2 / t, frequency^2 / (1 - t)).
struct GridLevels {
  double levels[kParts];  // NOLINT
};

/// A weight of curvature_weight.
[[nodiscard]] inline double grid_weight(int i) {
  double weight = 0.5;
  for (int k = 0; k < i; ++k) {
    weight *= 1.35;
  }
  return weight;
}

/// The functions for one set of instructions; all give the same bits.
struct GridFunctions {
  GridVariances (*variances)(const GridTask& task);
  void (*look)(const GridTask& task, GridView& view);
  void (*levels)(const GridTask& task, double signal, double frequency, GridLevels& found);
};
extern const GridFunctions kGridAvx2;
extern const GridFunctions kGridAvx512;
[[nodiscard]] const GridFunctions& grid_functions_of(trackers::InstructionSet set);
[[nodiscard]] const GridFunctions& grid_functions();

/// The directions of the phases at the points of the grid.
class PhaseGrid {
 public:
  explicit PhaseGrid(const WindowRequest& request);
  [[nodiscard]] GridTask task(const WindowAssumption& assumption, int window) const {
    return {request_.design, assumption, {kSettling, window, request_.slew}, sine_.data(), cosine_.data()};
  }

 private:
  WindowRequest request_;
  std::vector<double> sine_, cosine_;
};

}  // namespace veritrack::single_channel::detail
