// Do the assumed starts, which are errors from the true signal, enter a set around the steady state? With a
// leak.
#pragma once

#include <optional>
#include <vector>

#include "checker/quadrature/start_covariance.hpp"
#include "checker/quadrature/steady_set.hpp"

namespace veritrack::checker {

/// Upper bounds over all starts at all frequencies that were checked.
struct SteadyStart {
  Ball samples = zero;   ///< after which they are in Omega_1
  Ball level = zero;     ///< and at which level then
  Ball bound = zero;     ///< on |x3 - omega| at every sample, rad/sample
  Ball settling = zero;  ///< samples until they are in the last level
};

/// The certificate's statement on them. Starts are followed as far as that; frequencies are cut until it is
/// proved.
struct SteadyStartClaim {
  std::optional<Ball> samples, level, bound, settling;
};

/// Empty when the branch has no cell, or some start does not certainly enter the set. Starts outside are
/// followed, with the design's noise, when there is no slew. `covariance`: contains every P(0|0).
std::optional<SteadyStart> steady_start(const Design& design, const SteadySet& set,
                                        const std::vector<SteadyCell>& branch,
                                        const StartCovariance& covariance, const SteadyStartClaim& claim);

/// At least |e_i - e*_i| over level 1: amplitude, phase (rad), frequency (rad/sample).
std::array<Ball, 3> error_radii(const SteadySet& set);

}  // namespace veritrack::checker
