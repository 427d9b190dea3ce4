// A tracker that is started in one known state, whatever the phase and the frequency of the signal are: is it
// in a certified set after so many samples?
//
// At sample k the states are P_k(s, z) + U(phi + k omega, omega) xi, |xi| <= r_k: P_k is a polynomial in the
// place (s, z) of the phase at the start and of the frequency in a cell, U the shape of the tube. A step G is
// evaluated in ball models of xi, the noise, s and z: what depends on s and z alone is P_{k+1}; the rest, the
// errors of the models with it, is at most r_{k+1} long in the coordinates of the tube
// (docs/model-proof.md, section 16).
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "analysis/model/cell_cover.hpp"
#include "analysis/model/tube_step.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::model {

/// A tube, and its level R_0, at or below which a state stays for ever.
struct TubeOfLevel {
  const Tube* tube = nullptr;
  double level = 0.0;
};

struct StartQuestion {
  std::vector<rigor::Interval> state;  ///< one for each state of the tracker
  double noise = 0.0;                  ///< V: |v(k)| <= V, signal units
  std::size_t most_samples = 0;        ///< for how long starts are followed
};

/// What became of the start, over a cell of the phase at the start and of the frequency.
struct FollowedStart {
  bool is_captured = false;
  std::size_t samples = 0;          ///< captured: the state is at or below R_0 after so many
  rigor::Interval frequency_error;  ///< of samples 0, 1, ..., samples, rad/sample; empty: nothing is known
  std::string obstacle;             ///< not captured: what came in between
};

/// Follows the start. Angles count modulo 2 pi. Sets its own rounding mode. Throws std::invalid_argument when
/// sizes do not fit.
[[nodiscard]] FollowedStart follow_start(const TrackerModel& model, const TubeOfLevel& target,
                                         const TubeCell& cell, const StartQuestion& question);

struct StartCapture {
  rigor::Verdict verdict = rigor::Verdict::undecided;  ///< PROVED or UNDECIDED
  std::string reason;                                  ///< why not PROVED
  std::size_t samples = 0;                             ///< PROVED: the state is in the set after so many
  /// PROVED: of h - omega until then, rad/sample; empty when it is not known.
  rigor::Interval frequency_error;
  std::size_t cells = 0;  ///< that were needed
};

/// Whether the start is captured at every phase and at every frequency of each of the tubes: cells that are
/// not are halved, up to the budget, which is for each tube. The result does not depend on the number of
/// threads. That states at the levels stay there is the caller's to have proved. `progress`: of the tubes.
[[nodiscard]] StartCapture prove_start_captured(const TrackerModel& model,
                                                const std::vector<TubeOfLevel>& tubes,
                                                const StartQuestion& question,
                                                const VerificationBudget& budget,
                                                const std::function<void(double)>& progress = {});

/// After how many samples the start is in the tubes, by simulations without noise at some phases and
/// frequencies; the largest of them. `most` when one of them is not there until then. Not evidence.
[[nodiscard]] std::size_t simulated_capture(const TrackerModel& model, const std::vector<TubeOfLevel>& tubes,
                                            const std::vector<rigor::Interval>& state, std::size_t most);

}  // namespace veritrack::model
