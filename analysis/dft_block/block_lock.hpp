// Locks of the block tracker: fixed points of its map, proved to exist and to attract, the exact one and
// false ones biased by about a whole number of bins.
//
// With a matrix S and |s|_S = |S s|: if |G(s_0) - s_0|_S <= o, the largest singular value of S DG S^-1 is at
// most kappa on the ball B = {|s - s_0|_S <= rho}, kappa < 1 and o + kappa rho <= rho, then G maps B into
// itself and contracts it: B contains one fixed point, and each block multiplies the distance of every start
// in B from it by at most kappa, for ever (Banach). When the offset error of B stays away from zero, no start
// in B ever finds the tone.
#pragma once

#include <optional>

#include "analysis/dft_block/block_map.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::dft_block {

/// A ball about s_0 in a metric: exact doubles, proposed by anyone.
struct LockProposal {
  rigor::Vector<kStates> centre;
  rigor::Matrix<kStates> metric;  ///< S
  double radius = 0.0;            ///< rho
  double rate = 0.0;              ///< kappa
  int turns = 0;  ///< by which the phase error grows with each block: the point is fixed modulo 2 pi
};

/// The proof for a ball: an invariant set of starts, on the tone of the problem without noise.
struct BlockLock {
  LockProposal set;
  rigor::Interval offset_error;        ///< of every start in the set, and so for ever, bins
  rigor::Interval phase_error;         ///< likewise, at the middle of the block, rad
  rigor::Interval root_amplitude;      ///< likewise, x1 relative to the tone's
  rigor::Interval fixed_offset_error;  ///< of the fixed point, bins
  rigor::Interval amplitude;           ///< of the fixed point, x1^2 relative to the tone's
};

/// Proves that the ball is mapped into itself and contracted, and that its centre has a covariance, which is
/// positive definite; empty when that fails. The problem's intervals are any numbers in them. Needs the
/// upward mode.
[[nodiscard]] std::optional<BlockLock> verify_lock(const BlockProblem<rigor::Interval>& problem,
                                                   const LockProposal& proposal);

/// The end of the map's run from that state, in doubles, with a metric in which it contracts there and nearly
/// the largest radius of a few that is verified, at a rate with some room. Empty when the run does not end in
/// a fixed point, or nothing is verified. Needs the upward mode.
[[nodiscard]] std::optional<BlockLock> find_lock(const BlockProblem<rigor::Interval>& problem,
                                                 const rigor::Vector<kStates>& start);

}  // namespace veritrack::dft_block
