// A picture of one proved tube, with simulated errors in it.
#pragma once

#include "analysis/model/set/tube_set.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports {

/// At the middle of the band: what frequency errors the tube and its lowest level reach over the phase, and
/// simulated errors from the rim under the set's noise. For a set that is complete. Not drawn yet.
[[nodiscard]] Figure draw_tube(const model::TrackerModel& tracker, const model::TubeSet& set,
                               const certificates::FrequencyUnits& units);

}  // namespace veritrack::reports
