// The basin of attraction by simulation, for comparison with the proved region. It proves nothing.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/quadrature/capture/capture_region.hpp"

namespace veritrack::quadrature {

/// Starts on a grid, at the centres of equal rectangles over (phase error, frequency error), all with the
/// middle amplitude error. Without noise and slew, with the design's, the covariance's and the frequency's
/// midpoints.
struct SimulatedBasin {
  rigor::Interval phase_error;      ///< rad: the rectangles' range
  rigor::Interval frequency_error;  ///< rad/sample
  int phases = 0;
  int frequencies = 0;
  std::vector<char> locks;  ///< by phase, then by frequency: 1 when the run ended at zero frequency error

  [[nodiscard]] double phase(int index) const;      ///< of the grid point, rad
  [[nodiscard]] double frequency(int index) const;  ///< of the grid point, rad/sample
  [[nodiscard]] bool locks_at(int phase_index, int frequency_index) const;
};

/// Runs the tracker of trackers/quadrature/quadrature_ekf.hpp in double from each start for `samples`
/// samples; a run locks when its frequency error ends within 1e-3 of that of the true lock: 0 for epsilon =
/// 0, and for epsilon > 0 the error that a run from the exact start ends with. Runs on the threads that
/// oneTBB offers. Throws std::invalid_argument unless the ranges are finite and the numbers positive.
[[nodiscard]] SimulatedBasin simulate_basin(const CaptureProblem& problem, const StartBox& starts, int phases,
                                            int frequencies, int samples);

/// The proved part of the simulated basin, by counting the grid points that lock: those in PROVED cells only,
/// those that touch a REFUTED cell and no undecided one, and the rest. Cells of all amplitude errors count.
struct BasinShares {
  double proved = 0.0;
  double refuted = 0.0;
  double undecided = 0.0;
  std::size_t points = 0;  ///< that lock in simulation
};
[[nodiscard]] BasinShares shares_of_basin(const Region& region, const SimulatedBasin& basin);

}  // namespace veritrack::quadrature
