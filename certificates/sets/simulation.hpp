// The simulated run behind the audits and the figures: the double-precision tracker on a named test signal.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "analysis/theorems/trajectory.hpp"
#include "certificates/design/design.hpp"
#include "certificates/sets/assumptions.hpp"
#include "trackers/signals/test_signals.hpp"

namespace veritrack::certificates {

struct Simulation {
  theorems::Trajectory trajectory;  ///< in the units of the design file; record 0 is the start
  std::vector<std::string> notes;   ///< sentences: what the reader of the run must know of it
};

/// The test signal that [simulate] names, within [assume]. Needs round-to-nearest.
[[nodiscard]] std::vector<trackers::Sample> simulated_signal(const Assumptions& assume,
                                                             const SimulationSettings& settings);

/// Runs the tracker from the edge of the assumed start errors (amplitude, phase and frequency each wrong by
/// the most that is allowed) along the signal that [simulate] names. Holds round-to-nearest: this is the
/// tracker as it runs.
[[nodiscard]] Simulation simulate(const Design& design);

/// The same run as the tracker of unit amplitude sees it: signal and error divided by the amplitude, P scaled
/// with them.
[[nodiscard]] theorems::Trajectory at_unit_amplitude(theorems::Trajectory trajectory, double amplitude);

/// A covariance to start from, in the frame of the estimated phase.
struct SteadyState {
  Eigen::Matrix3d covariance;  ///< P(k|k), signal units and rad/sample
  bool settled = false;        ///< whether the filter came to rest within the steps that were tried
};

/// Where the noise-free tracker's covariance settles at a constant frequency (rad/sample), by iteration in
/// double: a floating-point proposal, no proof. When the tracker does not settle, the covariance after the
/// last step of the iteration with the estimation error held at zero.
[[nodiscard]] SteadyState find_steady_state(const Design& design, double frequency);

}  // namespace veritrack::certificates
