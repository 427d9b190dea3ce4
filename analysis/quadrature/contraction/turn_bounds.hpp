// By how much the measurement update turns the estimate of the quadrature tracker, at every amplitude of a
// set.
#pragma once

#include <vector>

#include "analysis/quadrature/contraction/correction.hpp"

namespace veritrack::quadrature {

/// Ranges of |z| that cover [1 - A, 1 + A], each with a bound on the |tangent| of the turns that occur there
/// in the set {(a/A)^2 + (chi/C)^2 <= 1}, noise up to V included; nothing when some turn may be a right
/// angle. Turns for chi < 0 mirror those for chi > 0. Needs the upward mode.
[[nodiscard]] std::vector<TurnBound> bound_turns(const StepSetting<rigor::Interval>& setting);

}  // namespace veritrack::quadrature
