// Bounds on the estimated frequency in a tube: its error, the mean and the range of the error over the phase,
// and the reach of the tube.
#pragma once

#include <vector>

#include "analysis/model/step/tube_step.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// The number of parts into which a turn and the band of a tube are divided: powers of two.
struct ErrorGrid {
  int phases = 128;
  int frequencies = 4;
  /// The number of parts into which those phases are divided, for the ripple, at which the error may be
  /// largest or smallest: 1 leaves them whole.
  int finer = 1;
};

/// h - omega, rad/sample, for all |xi| <= radius, phases and frequencies of the tube. Empty or NaN where
/// nothing is known.
struct TubeErrors {
  /// The same for a part of the frequencies.
  struct Slice {
    double low = 0.0;  ///< rad/sample, to the nearest double
    double high = 0.0;
    rigor::Interval mean;
    double ripple = 0.0;
  };
  rigor::Interval error;  ///< contains all
  /// Contains the mean over the phase for each frequency, whatever xi does while the phase turns.
  rigor::Interval mean;
  /// For each frequency the largest minus the smallest over the phase is at most this. (At one frequency: the
  /// change of the mean between frequencies is not counted.)
  double ripple = 0.0;
  std::vector<Slice> slices;  ///< from low frequencies to high ones; none where nothing is known
};

/// Throws std::invalid_argument when sizes do not fit or the grid is invalid.
[[nodiscard]] TubeErrors bound_errors(const TrackerModel& model, const Tube& tube, double radius,
                                      const ErrorGrid& grid);

/// A lower bound of the reach of the tube: at every phase and frequency it has states with h - omega >=
/// reach, and others with h - omega <= -reach, rad/sample. 0 where nothing is known. Throws
/// std::invalid_argument when sizes do not fit or the grid is invalid.
[[nodiscard]] double bound_reach(const TrackerModel& model, const Tube& tube, double radius,
                                 const ErrorGrid& grid);

/// An upper bound of |U^-1 d| for all deviations |d_i| <= deviations[i] from the curve, all phases and
/// frequencies of the tube: the level of such starts. Infinity where nothing is known. Throws
/// std::invalid_argument when sizes do not fit, the grid is invalid, or more than 12 deviations are not 0.
[[nodiscard]] double bound_start(const TrackerModel& model, const Tube& tube,
                                 const std::vector<rigor::Interval>& deviations, const ErrorGrid& grid);

}  // namespace veritrack::model
