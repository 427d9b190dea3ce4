// Simulations of starts far from the curve of a tube: which of them come into it, and when. They prove
// nothing. Also the edge of the tube among these starts, in floating point.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "analysis/model/map/capture_map.hpp"

namespace veritrack::model {

/// The results for the middles of the cells of a grid, without noise.
struct SimulatedStarts {
  int phases = 0;                    ///< of the signal at the start, equally spaced
  std::vector<int> locked;           ///< the number of phases at which the start comes into the tube, by cell
  std::vector<std::size_t> samples;  ///< the samples after which it is there at most, by cell, where it is
  std::size_t longest = 0;           ///< of all cells that lock at every phase

  [[nodiscard]] bool locks(std::size_t cell) const { return locked[cell] == phases; }
};

/// Runs the recursion in double for at most `most_samples` samples. Angles count modulo 2 pi. Runs on the
/// threads that oneTBB offers; holds round-to-nearest.
[[nodiscard]] SimulatedStarts simulate_starts(const CaptureProblem& problem, const CaptureGrid& grid,
                                              int phases, std::size_t most_samples);

/// The deviations of two states, the others on the curve, with which starts are in the tube at every phase:
/// points of the edge around 0, in the units of x and y, `count` of them and the first one again. `x_unit`,
/// `y_unit` set the directions.
[[nodiscard]] std::vector<std::array<double, 2>> edge_of_section(const CaptureProblem& problem,
                                                                 std::size_t x_state, double x_unit,
                                                                 std::size_t y_state, double y_unit,
                                                                 int count);

}  // namespace veritrack::model
