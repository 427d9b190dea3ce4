// A block of the block tracker on a tone of constant offset and amplitude without noise, as a map of nine
// numbers, and balls of states that are never left: docs/block-tracker.md, section 6.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "checker/numbers/gradient.hpp"
#include "checker/numbers/matrix.hpp"

namespace veritrack::checker {

inline constexpr std::size_t kBlockStates = 9;
using BlockNumber = Gradient<Ball, kBlockStates>;
/// z_1, z_2, z_3 of the prediction, and P_11, P_12, P_13, P_22, P_23, P_33 in the same coordinates.
using BlockNumbers = std::array<BlockNumber, kBlockStates>;

/// Relative to the tone.
struct BlockTone {
  Ball q1, q2, q3;  ///< q1 4 pi / amplitude; q2 and q3 as the design has them
  Ball weight;      ///< amplitude^2 / (4 r)
  Ball offset;      ///< bins
  int half_width = 0;
};

/// The state after one more block, with its derivatives along those of `state`.
BlockNumbers block_step(const BlockNumbers& state, const BlockTone& tone);

/// The s with |S (s - centre)| <= radius.
struct BlockBall {
  std::array<Ball, kBlockStates> centre;
  Matrix shape{static_cast<slong>(kBlockStates), static_cast<slong>(kBlockStates)};  ///< S
  Ball radius, rate;
  Ball turns;  ///< the growth of the phase error with each block, turns
};

struct BlockBallFound {
  bool is_kept = false;      ///< mapped into itself, and contracted by the rate
  std::vector<Range> all;    ///< the states of the ball
  std::vector<Range> fixed;  ///< those of the fixed point
};

/// The states are unknown unless it is kept.
BlockBallFound check_ball(const BlockBall& ball, const BlockTone& tone);

}  // namespace veritrack::checker
