// The larger one of two numbers of which one may not be a number: std::max may drop it.
#pragma once

#include <limits>

namespace veritrack::rigor {

/// The larger one; NaN where one of them is.
[[nodiscard]] inline double larger_or_nan(double a, double b) {
  return a >= b ? a : a < b ? b : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace veritrack::rigor
