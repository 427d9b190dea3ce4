// The largest disturbance that a proof tolerates.
#pragma once

#include <algorithm>
#include <functional>

namespace veritrack::model {

/// Nearly the largest number up to `most` with this property, which smaller ones have; 0 where none was
/// found. A little less than what was found, for a program whose bounds are cruder.
[[nodiscard]] inline double largest_with(double most, const std::function<bool(double)>& holds,
                                         int steps = 11) {
  constexpr int kHalvings = 60;
  constexpr double kRoom = 0.998;
  double low = most;
  for (int i = 0; i < kHalvings && !holds(low); ++i) {
    low *= 0.5;
  }
  if (!holds(low)) {
    return 0.0;
  }
  double high = std::min(most, 2.0 * low);
  for (int i = 0; i < steps; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return kRoom * low;
}

}  // namespace veritrack::model
