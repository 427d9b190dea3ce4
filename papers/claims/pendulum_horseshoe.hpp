// Chaos of the impulsive pendulum (trackers/pendulum/impulsive_pendulum.hpp), by verified integration.
//
// f is free motion for tau, then the impulse of (pi/2) h = pi rad, at b = 0.2, h = 2, tau = 4.32. Coordinates
// (a, c) about a centre: centre + a u + c s, u and s near the unstable and the stable direction of a fixed
// point. Let M be |a| <= 1/4, |c| <= 0.3 about that centre, L and R its parts with |a| <= 0.04 and 0.1 <= a
// <= 0.22, M' the mirror image -M, moved by two turns. This is verified:
//   f(L) crosses M and f(R) crosses M': no image point has |a| <= 1/4 and |c| >= 0.3 in the target's
//   coordinates, the left edge of the part has its image left of the target, a < -1/4, the right one right of
//   it.
// Then a curve in a part from the left edge to the right one has an image with a piece in the target from its
// left edge to its right one, and that has pieces in both parts of the target. f(-z) = -f(z) modulo turns, so
// that the mirrored parts do the same. Hence every sequence of "left" and "right" is the itinerary of a state
// (a nested intersection of compact sets): f has at least the topological entropy log 2.
#pragma once

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::theorems {

/// Angle (rad) and rate of states.
struct PendulumBox {
  rigor::Interval angle, rate;
};

/// Where the states centre + a u + c s, for a and c in these intervals, are after free motion for 4.32 at b =
/// 0.2, and an impulse of pi. Needs the upward rounding mode. Not finite where nothing is known.
[[nodiscard]] PendulumBox image_of_states(const rigor::Interval& a, const rigor::Interval& c);

/// The centre and the directions u and s, of length about 1, in that order.
struct PendulumFrame {
  rigor::Interval angle, rate, u_angle, u_rate, s_angle, s_rate;
};
[[nodiscard]] PendulumFrame pendulum_frame();

/// left <= a <= right, |c| <= height.
struct PendulumPart {
  double left, right;
  const char* height = "0.3";  ///< a decimal
};

/// Does the image of the part cross |a| <= 1/4, |c| <= height, about the centre, or about its mirror image
/// moved by two turns? PROVED or UNDECIDED; `boxes`, where given, grows by how many boxes of starts it took.
/// Needs the upward rounding mode.
[[nodiscard]] rigor::Verdict crosses(const PendulumPart& part, bool is_mirrored, long* boxes = nullptr);

/// PROVED when what stands above is verified, else UNDECIDED. Needs the upward rounding mode. Some tenths of
/// a second.
[[nodiscard]] rigor::Verdict has_horseshoe(long* boxes = nullptr);

}  // namespace veritrack::theorems
