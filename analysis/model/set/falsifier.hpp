// An attempt to leave proved tubes, with the tracker in floating point. Proves nothing; a tube that is left
// is an alarm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "analysis/model/set/tube_set.hpp"
#include "analysis/model/step/point_tube.hpp"

namespace veritrack::model {

/// The tone of a simulation, and its disturbances. At each sample the disturbances are chosen, among those
/// that are tried, so that the next level is the largest.
struct AttackedTone {
  double frequency = 0.0;  ///< rad/sample, at the start
  double phase = 0.0;      ///< rad, at the start
  double noise = 0.0;      ///< its length, signal units: both signs of one channel, 16 directions of two
  double slew = 0.0;       ///< up or down, rad/sample per sample; the frequency stays in the tube's cell
};

/// A sample of a simulation.
struct AttackedSample {
  double phase = 0.0;            ///< rad, not reduced
  double level = 0.0;            ///< |xi|: of the rim it is R_0
  double frequency_error = 0.0;  ///< rad/sample
};

/// The simulation from a start of these coordinates, its start included. Ends early where a state is not
/// finite.
[[nodiscard]] std::vector<AttackedSample> simulate_attack(const TrackerModel& model, const Tube& tube,
                                                          const AttackedTone& tone,
                                                          const Eigen::VectorXd& start, int samples);

/// The effort of the attempt.
struct AttackSettings {
  int starts = 200;    ///< over all tubes of a set
  int samples = 2000;  ///< from each start
  int ascents = 4;     ///< of the level after one sample, over the rim, before each run
  std::uint64_t seed = 20261121;
};

/// The values that the simulations reached. Infinite when one left the finite numbers.
struct TubeAttack {
  int starts = 0;
  int samples = 0;               ///< from each
  double level_share = 0.0;      ///< the largest level after the start, over the proved one: R_0
  double frequency_error = 0.0;  ///< the largest |h - omega|, starts included, rad/sample
};

/// Starts on the rim of R_0, in all tubes in turn, at frequencies, phases and in directions drawn at random;
/// a direction is improved until the next level is large. With the noise and the slew of the set. The
/// covariance of a filter with bounds begins at one of them, or between them with nothing to spare.
/// Deterministic, whatever the number of threads. For a set without tubes nothing is tried.
[[nodiscard]] TubeAttack attack_tubes(const TrackerModel& model, const TubeSet& set,
                                      const AttackSettings& settings = {});

}  // namespace veritrack::model
