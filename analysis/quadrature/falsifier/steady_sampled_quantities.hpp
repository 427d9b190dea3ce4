// The results of a search against a certificate with a leak, which show how tight it is. None of it is
// proved.
#pragma once

#include <vector>

#include "analysis/quadrature/falsifier/falsifier_run.hpp"
#include "analysis/sets/fixed_point_bias.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::quadrature {

/// The claims that a PROVED set makes at the lowest, a middle and the highest cell of the branch, in floating
/// point; none where no steady state is found. Opens its own NearestRounding scope.
[[nodiscard]] std::vector<SetClaim> claims_of(const trackers::ToneModel<rigor::Interval>& design,
                                              const sets::LockBranch& branch, const SteadySet& set);

/// Appends, marked as not proved, the worst values at those frequencies: frequency_error_radius_sampled_limit
/// (rad/sample about the steady state, see sampled_radius_limit), frequency_error_radius_share_of_limit, and
/// the share that the falsifier reached of the distance from the steady state in level 1
/// (frequency_error_bound_tightness) and in the last level (ultimate_frequency_error_tightness). Needs the
/// upward mode.
void add_steady_sampled_quantities(const std::vector<SetClaim>& claims, theorems::Derivation& derivation);

}  // namespace veritrack::quadrature
