// How far a slew of the frequency carries a state from its steady state. With a leak.
#pragma once

#include <optional>
#include <vector>

#include "analysis/quadrature/leak/steady_set.hpp"
#include "analysis/sets/fixed_point_bias.hpp"

namespace veritrack::quadrature {

/// In units of the level, upper bounds: the errors in the metric, the covariance as a share of its bounds.
struct SteadyMotion {
  rigor::Interval errors = rigor::Interval(0.0);
  rigor::Interval covariance = rigor::Interval(0.0);
};

/// The motion of the steady state by the slew of the set in one sample, uniform over the branch, since a step
/// may pass from one cell to another; nothing when it could not be enclosed. Needs the upward mode.
[[nodiscard]] std::optional<SteadyMotion> steady_motion(const trackers::ToneModel<rigor::Interval>& design,
                                                        const std::vector<sets::BranchCell>& branch,
                                                        const SteadySet& set);

}  // namespace veritrack::quadrature
