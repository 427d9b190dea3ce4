#include "analysis/theorems/error_recursion_search.hpp"

namespace veritrack::theorems {

using rigor::Interval;

std::vector<ErrorRecursion> recursion_ladder(const IntervalDesign& design) {
  constexpr double kSmallest = 1e-6;
  constexpr double kLargest = 0.4;
  constexpr double kStep = 1.5;
  std::vector<ErrorRecursion> ladder;
  for (const int window : {0, 1, 2, 3, 4, 6}) {
    // Both limits of the tube should be reached at the same W.
    double ratio = 1.0;
    double plane_error = kSmallest;
    while (plane_error < kLargest) {
      const auto recursion =
          error_recursion(design, {Interval(plane_error), Interval(ratio * plane_error)}, window);
      if (!recursion) {
        break;  // a wider tube only makes it worse
      }
      ratio = recursion->frequency_gain.upper() / recursion->plane_gain.upper();
      ladder.push_back(*recursion);
      plane_error *= kStep;
    }
  }
  return ladder;
}

std::optional<ErrorRecursion> best_recursion(const std::vector<ErrorRecursion>& ladder,
                                             const std::function<double(const ErrorRecursion&)>& score) {
  std::optional<ErrorRecursion> best;
  double highest = 0.0;
  for (const ErrorRecursion& recursion : ladder) {
    const double value = score(recursion);
    if (value > highest) {
      highest = value;
      best = recursion;
    }
  }
  return best;
}

}  // namespace veritrack::theorems
