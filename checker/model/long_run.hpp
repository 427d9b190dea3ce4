// From the tubes of a filter into those for the long run, whose bounds of the covariance are narrower.
//
// The estimate stays at the last level of a tube of the first set, and the covariance between its bounds
// low_0 and high_0, with high_0 <= c high_1 and low_1/c <= low_0. For these estimates the bounds c high_1 and
// low_1/c have a margin to spare, for every c from 1 to the first one: a sample later they are those of (1 -
// margin) c. So the covariance comes between low_1 and high_1, and stays there.
#pragma once

#include <cstdint>

#include "checker/model/tube_check.hpp"

namespace veritrack::checker {

/// For two sets that are invariant as long as the covariance is between their bounds: true only when both
/// have the same noise and cells, and a state that stays for ever at the last level of a tube of `around` is,
/// and stays, in the tube of `inner` of its cell from some sample on, samples_to_long_run() later. Objects
/// otherwise.
bool is_entered(const TrackedModel& model, const TubeSet& around, const TubeSet& inner, std::int64_t& cells,
                Objections& objections);

/// An upper bound on the number of samples at the last level of the other tube after which a state is in this
/// one.
Ball samples_to_long_run(const PhaseTube& inner);

}  // namespace veritrack::checker
