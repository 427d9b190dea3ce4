// The simulated run behind the audits and the figures: the double-precision tracker on a named test signal.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "analysis/statements/trajectory.hpp"
#include "certificates/design/design.hpp"
#include "certificates/sets/assumptions.hpp"
#include "trackers/signals/test_signals.hpp"

namespace veritrack::certificates {

struct Simulation {
  theorems::Trajectory trajectory;  ///< in the units of the design file; record 0 is the start
  std::vector<std::string> notes;   ///< sentences: remarks for the reader of the run
};

/// The test signal that [simulate] names, within [assume]. Needs round-to-nearest.
[[nodiscard]] std::vector<trackers::Sample> simulated_signal(const Assumptions& assume,
                                                             const SimulationSettings& settings);

/// The same run as the tracker of unit amplitude sees it: signal and error divided by the amplitude, P scaled
/// with them.
[[nodiscard]] theorems::Trajectory at_unit_amplitude(theorems::Trajectory trajectory, double amplitude);

}  // namespace veritrack::certificates
