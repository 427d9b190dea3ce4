// A tracker that is started in one known state, on its way into a tube, over a cell of the phase at the start
// and of the frequency.
//
// At sample k the states are P_k(s, z) + U(phi + k omega, omega) xi, |xi| <= r_k: P_k is a polynomial in the
// place (s, z) of the phase at the start and of the frequency in a cell, U the shape of the tube. A step G is
// evaluated in ball models of xi, the noise, s and z: the terms in s and z alone are P_{k+1}; the rest, with
// the errors of the models, is at most r_{k+1} long in the coordinates of the tube (docs/model-proof.md,
// section 16).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/model/step/tube_step.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// A tube, and its level R_0, at or below which a state stays for ever.
struct TubeOfLevel {
  const Tube* tube = nullptr;
  double level = 0.0;
};

struct StartQuestion {
  std::vector<rigor::Interval> state;  ///< one for each state of the tracker
  double noise = 0.0;                  ///< V: |v(k)| <= V, signal units
  std::size_t most_samples = 0;        ///< the number of samples for which starts are followed
};

/// The outcome of the start, over a cell of the phase at the start and of the frequency.
struct FollowedStart {
  bool is_captured = false;
  std::size_t samples = 0;          ///< captured: the state is then at or below R_0
  rigor::Interval frequency_error;  ///< of samples 0, 1, ..., samples, rad/sample; empty: nothing is known
  std::string obstacle;             ///< not captured: the obstacle
};

/// Follows the start. Angles count modulo 2 pi. Sets its own rounding mode. Throws std::invalid_argument when
/// sizes do not fit.
[[nodiscard]] FollowedStart follow_start(const TrackerModel& model, const TubeOfLevel& target,
                                         const TubeCell& cell, const StartQuestion& question);

}  // namespace veritrack::model
