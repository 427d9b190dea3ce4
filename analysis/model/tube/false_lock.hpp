// How near a false lock may be: a frequency at which the tracker may settle instead of the true one, as far
// as its formulas and the signal's show (docs/model-proof.md, section 18).
#pragma once

#include "analysis/model/step/tube_step.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// Less than the frequency error, rad/sample, from which a state may be nearer to a false lock than to the
/// true one, for all frequencies of the band (rad/sample). For a filter, with the slack that an independent
/// program may need because it counts the degrees of derivatives differently. Needs the upward rounding mode.
[[nodiscard]] double half_distance_to_false_lock(const TrackerModel& model, const rigor::Interval& band);

}  // namespace veritrack::model
