// A tracker that is started in one known state: is it in a set of tubes after a given number of samples,
// whatever the phase and the frequency of the signal are?
//
// The states after k samples are P(s, z) + U x, |x| <= r: P is a polynomial in the place of the phase at the
// start and of the frequency, U the shape of the tube at the phase phi + k omega. In the result of a step, an
// identity of ball polynomials, the terms in s and z alone are the next P; the rest, with all errors, is
// bounded in the coordinates of the tube.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "checker/model/tube_step.hpp"

namespace veritrack::checker {

/// The statement on a start.
struct StartClaim {
  std::vector<Ball> state;
  Ball noise;                           ///< |v| <= noise, signal units
  std::size_t samples = 0;              ///< until it is in the set
  std::optional<Ball> frequency_error;  ///< |h - omega| until it is there, at most, rad/sample
  std::size_t phases = 0;               ///< parts of a turn, and of the frequencies of a tube, to begin with
  std::size_t frequencies = 0;
};

/// True only when it is certain for all phases, all frequencies of all tubes and all noise: after at most
/// `samples` samples a state is at level R_0 or below, where it stays in a set that is never left. False
/// where there are no tubes, samples or parts. Parts of phases and frequencies are halved until it is
/// certain, and counted in `cells`.
bool is_captured(const TrackedModel& model, const TubeSet& set, const StartClaim& start, std::int64_t& cells);

}  // namespace veritrack::checker
