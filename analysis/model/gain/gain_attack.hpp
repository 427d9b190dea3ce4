// An attack on a loop's bounds: the noise and the slew that add up at one sample, by the adjoint of the
// linear recursion, and what a simulation reaches with them. Not evidence.
#pragma once

#include "analysis/model/gain/loop_network.hpp"

namespace veritrack::model {

/// The largest frequency error, rad/sample, that is reached after `samples` samples from the steady state, at
/// the frequency `omega`. Holds round-to-nearest.
[[nodiscard]] double attack_loop(const TrackedTone& tone, const std::vector<SteadyValue>& steady,
                                 double omega, double noise, double slew, std::size_t samples);

}  // namespace veritrack::model
