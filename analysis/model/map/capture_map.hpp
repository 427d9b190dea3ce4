// Which starts far from the steady state are captured by a certified tube: a grid of deviations of two
// states, cell by cell, each for all phases of the signal.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/model/capture/capture_set.hpp"
#include "analysis/search/deadline.hpp"

namespace veritrack::model {

/// Deviations from the curve in two states, divided into cells.
struct CaptureGrid {
  std::size_t x_state = 0;
  std::size_t y_state = 1;
  std::vector<double> x, y;  ///< ends of the columns and of the rows, ascending: one more than there are

  [[nodiscard]] std::size_t columns() const { return x.size() - 1; }
  [[nodiscard]] std::size_t rows() const { return y.size() - 1; }
  [[nodiscard]] std::size_t cells() const { return columns() * rows(); }
  /// Number of the cell: row by row.
  [[nodiscard]] std::size_t cell(std::size_t column, std::size_t row) const {
    return row * columns() + column;
  }
};

/// `count` equal cells in each direction, up to the ranges on both sides of 0. Throws std::invalid_argument
/// unless the numbers are positive and finite and the states differ.
[[nodiscard]] CaptureGrid capture_grid(std::size_t x_state, double x_range, std::size_t y_state,
                                       double y_range, int count);

struct CaptureOptions {
  int phases = 32;               ///< cells of the phase to begin with: a power of two
  int phase_halvings = 1;        ///< of each, at most
  int cell_halvings = 4;         ///< of a cell of the grid, at most
  std::size_t most_samples = 0;  ///< the number of samples for which a start is followed
  std::size_t stride = 4;        ///< samples between two looks at whether it is in the tube
  double tolerance = 0.0;        ///< the most that a step may add to the radius, as a share of R_0
  std::size_t most_steps = 0;    ///< for all starts of a ring at one cell of phases
  /// The cells are followed ring by ring, from the middle outwards: the proof for a ring stays when the
  /// deadline ends the work on a later one.
  int rings = 1;
  search::Deadline deadline = {};
};

/// The result for a cell of the grid.
struct CapturedCell {
  /// All starts in it, at all phases of the signal and for all noise, are in the tube after `samples`
  /// samples, angles modulo 2 pi, and stay.
  bool is_proved = false;
  std::size_t samples = 0;     ///< when proved
  bool is_unfinished = false;  ///< the deadline came first
};

/// The share that is done.
using CaptureProgress = std::function<void(double share)>;

/// Follows the starts of those cells that are wanted (one entry for each cell; the others are not proved).
/// Runs on the threads that oneTBB offers; the result does not depend on their number. `progress` is called
/// from the calling thread. Sets its own rounding mode. Throws std::invalid_argument when sizes do not fit.
[[nodiscard]] std::vector<CapturedCell> prove_captured(const CaptureProblem& problem, const CaptureGrid& grid,
                                                       const std::vector<char>& wanted,
                                                       const CaptureOptions& options,
                                                       const CaptureProgress& progress = {});

}  // namespace veritrack::model
