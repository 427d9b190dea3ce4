// The box over which the errors of a KKL observer are searched for their largest.
#pragma once

#include "analysis/kkl_observer/kkl_error_map.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::kkl_observer {

/// Signal frequency (rad/s), its phase (rad), its amplitude, and two numbers that locate the disturbance.
inline constexpr int kKklSearchVariables = 5;
using KklSearchBox = rigor::IntervalVector<kKklSearchVariables>;

/// [0, upper end of a turn times `turns`], rad.
[[nodiscard]] inline rigor::Interval turns(double turns) {
  using rigor::Interval;
  return Interval::from_bounds(0.0, (Interval(turns) * Interval(2.0) * rigor::pi()).upper());
}

}  // namespace veritrack::kkl_observer
