// Tubes over a band in which the frequency moves, from the tube of one cell into that of the next.
#pragma once

#include "analysis/model/set/tube_set.hpp"

namespace veritrack::model {

/// As prove_set, for a frequency that moves: all cells have the same levels, and their borders are verified.
[[nodiscard]] TubeSet prove_moving_set(const TrackedTone& tone, const TrackerModel& model, double low,
                                       double high, const SetTask& task, const SetProgress& progress = {});

}  // namespace veritrack::model
