// What rounding adds to a loop: an input to each state at each sample, as long as the states stay in ranges.
#pragma once

#include <vector>

#include "analysis/model/gain/loop_network.hpp"
#include "analysis/model/step/program_rounding.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// Rounding in a loop about its steady state.
struct LoopRounding {
  std::vector<double> room;  ///< by state: how far it may be from the steady state; infinite for angles
  std::vector<double> next;  ///< by state: what a step is off, at most
  double frequency = 0.0;    ///< the same of the reported frequency, rad/sample
  double turned = 0.0;       ///< the angle of the samples is off by up to this, rad
  double amplitude = 0.0;    ///< of the samples, at most
  double most_noise = 0.0;   ///< signal units
};

/// The rounding of a step while no state is further than `room` from the steady state, at the frequencies of
/// the band and with noise below the amplitude. Throws NoRounding. Needs the upward rounding mode.
[[nodiscard]] LoopRounding rounding_within(std::vector<double> room, const RoundingOfStep& rounding,
                                           const TrackerModel& tracker,
                                           const std::vector<SteadyValue>& steady,
                                           const rigor::Interval& band);

/// Adds an input to each state, forms that are the states, the limits to their room, and what turns the
/// samples.
void add_rounding(LoopNetwork& network, const LoopRounding& rounding);

}  // namespace veritrack::model
