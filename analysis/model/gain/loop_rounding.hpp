// What rounding adds to a loop: an input to each state at each sample, as long as the states stay in ranges.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "analysis/model/gain/loop_network.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// Bounds on what a program is off in a step, of the states and of the frequency that it reports, for these
/// ranges of its states and samples; those of angles are not asked for. Empty where no bound is known.
using RoundingOfStep = std::function<std::optional<std::vector<double>>(
    const std::vector<rigor::Interval>& states, const rigor::Interval& sample)>;

/// Rounding in a loop about its steady state.
struct LoopRounding {
  std::vector<double> room;  ///< by state: how far it may be from the steady state; infinite for angles
  std::vector<double> next;  ///< by state: what a step is off, at most
  double frequency = 0.0;    ///< the same of the reported frequency, rad/sample
};

/// The rounding of a step while no state is further than `room` from the steady state, at the frequencies of
/// the band and with noise below the amplitude. Empty where no bound is known. Needs the upward rounding
/// mode.
[[nodiscard]] std::optional<LoopRounding> rounding_within(std::vector<double> room,
                                                          const RoundingOfStep& rounding,
                                                          const TrackerModel& tracker,
                                                          const std::vector<SteadyValue>& steady,
                                                          const rigor::Interval& band);

/// Adds an input to each state, forms that are the states, and the limits to their room.
void add_rounding(LoopNetwork& network, const LoopRounding& rounding);

}  // namespace veritrack::model
