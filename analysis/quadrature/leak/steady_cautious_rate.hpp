// A rate of a step that leaves room for its proof: sets that are proposed by it are easy to verify.
#pragma once

#include "analysis/quadrature/leak/steady_bounds.hpp"

namespace veritrack::quadrature {

/// An upper bound, in double, on the share of the level that a step from this place fills, without slew. It
/// does not use that (x, y) is known: the step is constant + slope u for any |u| <= 1, its two factors are
/// taken at (x, y), and what the noise does, relative to the amplitude, is added as a length. For proposals
/// only; infinity where no multipliers prove a rate.
[[nodiscard]] double cautious_rate(const SteadySetting<double>& setting, const SteadyPlace<double>& place,
                                   const SteadyStep<double>& step, const SteadyBounds<double>& bounds,
                                   double noise);

}  // namespace veritrack::quadrature
