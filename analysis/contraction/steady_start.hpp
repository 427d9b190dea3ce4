// Where the assumed starts lie in a set around the steady state.
#pragma once

#include <optional>
#include <vector>

#include "analysis/contraction/fixed_point_bias.hpp"
#include "analysis/contraction/quadrature_certificate.hpp"
#include "analysis/contraction/steady_set.hpp"

namespace veritrack::contraction {

/// An upper bound on the level s for which every assumed start lies in Omega_s(omega), for every frequency of
/// the cells. The errors are about the truth; the covariance P(0) is in the frame of the estimated phase, and
/// P*(omega) itself where none is given. Nothing when no level holds the given covariance. Needs the upward
/// mode.
[[nodiscard]] std::optional<rigor::Interval> start_level(
    const ContractionQuestion& question,
    const std::vector<FixedPointTube<QuadraturePolarLoop::kStates>>& cells, const SteadySet& set);

}  // namespace veritrack::contraction
