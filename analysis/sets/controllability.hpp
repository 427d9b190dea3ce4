// Is there a direction of the quadrature tracker's state that its process noise never reaches?
//
// A pair (F, Q) has an uncontrollable mode lambda when some w != 0 has w'F = lambda w' and w'Q = 0 (Popov,
// Belevitch, Hautus). One on the unit circle excludes a steady state whose errors die out exponentially; see
// find_uncontrollable_mode. At the exact estimate, and in the frame that turns with the true phase, the
// tracker has F
// =
// [[1, 0, 0], [0, 1, 1], [0, 0, 1 - epsilon]] and Q = diag(q1, q1, q2).
#pragma once

#include <string>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/rigor/verdict.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::sets {

/// An uncontrollable mode of (F, Q) on the unit circle, with its witness.
struct UncontrollableMode {
  /// PROVED: for every design of the question the witness below is an uncontrollable mode with |lambda| = 1,
  /// and therefore the tracker has no unbiased steady state from which small errors decay exponentially.
  /// UNDECIDED: no conclusion; in particular not that such a steady state exists.
  rigor::Verdict verdict = rigor::Verdict::undecided;
  std::string reason;                      ///< one sentence for the certificate
  rigor::IntervalMatrix<3> transition;     ///< F, in the frame that turns with the true phase
  rigor::IntervalMatrix<3> process_noise;  ///< Q
  rigor::Vector<3> left_eigenvector;       ///< w: (in-phase = amplitude, quadrature, frequency)
  double eigenvalue = 0.0;                 ///< lambda
};

/// Looks for the mode that q1 = 0 and epsilon = 0 leave undriven: the amplitude. Every step of the argument
/// is an exact evaluation in intervals: w'F - lambda w' and w'Q are the point zero. Holds its own rounding
/// mode.
///
/// Why it excludes exponential stability: near the exact estimate the errors propagate by (I - K H) F, with K
/// = M H' S^-1, M = F P F' + Q, and P+ = M - M H' S^-1 H M. With w'F = lambda w', w'Q = 0 and |lambda| = 1
/// one has w'M w = w'P w. At a fixed point P+ = P then w'M H' S^-1 H M w = 0, so H M w = 0 and w'K = 0, and
/// w'(I - K H) F = w'F = lambda w': lambda is an eigenvalue of the errors' own propagation, whatever P is.
[[nodiscard]] UncontrollableMode find_uncontrollable_mode(const trackers::ToneModel<rigor::Interval>& design);

}  // namespace veritrack::sets
