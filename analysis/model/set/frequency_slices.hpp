// Bounds on the estimate in slices of the band: for figures and tables.
#pragma once

#include <vector>

#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// Frequencies from low to high, rad/sample, and bounds that are valid at each of them. Infinite, or empty,
/// where nothing is known.
struct FrequencySlice {
  double low = 0.0, high = 0.0;
  rigor::Interval bias;  ///< contains the mean error over the phase, rad/sample
  double ripple = 0.0;   ///< of the error over the phase, at most, rad/sample
  double reach = 0.0;    ///< of the tube, at least, rad/sample
};

/// The larger one; infinity when one of them is unknown: infinite or not a number.
[[nodiscard]] double larger_bound(double a, double b);

/// Bounds that are valid in each of several lists, for instance for each part of the amplitudes, at the
/// frequencies that all of them cover.
[[nodiscard]] std::vector<FrequencySlice> worst_of(const std::vector<std::vector<FrequencySlice>>& lists);

}  // namespace veritrack::model
