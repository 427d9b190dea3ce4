// The steady state of the single-channel tracker on a noise-free tone is a curve over the phase. Here it is
// proved to exist near a proposed one, and to attract.
//
// In the frame of the true phase the closed loop is (phi, X) -> (phi + omega, G_phi(X)), pi-periodic in phi
// (tone_step.hpp). Given a trigonometric polynomial C(phi), a partition of [0, pi) into cells, an invertible
// R_i for each, |x|_phi = |R_i x| for phi in cell i, and numbers kappa < 1, rho, r, suppose that
//   (a)  |G_phi(C(phi)) - C(phi + omega)|_(phi + omega) <= rho for all phi,
//   (b)  |DG_phi(C(phi) + x) y|_(phi + omega) <= kappa |y|_phi for all phi, |x|_phi <= r and y,
//   (c)  kappa r + rho <= r.
// Then for functions X(phi) with |X(phi) - C(phi)|_phi <= r the map X -> (phi + omega -> G_phi(X(phi))) has
// values of the same kind, by (a), (b), (c) and the mean value theorem (balls are convex), and shrinks
// distances in the supremum of |.|_phi to kappa. The norms are equivalent to one another, so that the space
// is complete, and continuous functions stay continuous: there is one invariant curve X*, it is continuous,
// |X* - C|_phi <= kappa |X* - C| + rho gives |X* - C|_phi <= rho / (1 - kappa), and every start in the tube
// converges to it by kappa a sample.
//
// (a) All components, to W C: |x|_phi <= S |W x| with S the largest Frobenius norm of R_i W^-1. Over a cell,
// by the Taylor polynomial in the phase about its middle, with Lagrange's remainder over the whole cell.
// (b) (kappa R_i V)'(kappa R_i V) - (R_j J V)'(R_j J V) is positive definite for every cell j that can
// follow. R_j J V over a cell: the second Taylor polynomial in the phase, plus what its derivative by the
// frequency adds. |x|_phi <= r is enclosed in |W_k x_k| <= sqrt(2) r, for R_i'R_i - W^2/2 is positive
// definite.
// An interval of frequencies: C depends on t as a polynomial of degree 4. Between the five nodes the
// difference in (a) is at most 11 times the largest at a node, plus |fifth Taylor coefficient in t| / 4: the
// Lagrange polynomials of -1, -1/2, 0, 1/2, 1 are at most 1, 4, 1, 4, 1 on [-1, 1], and
// |t (t^2 - 1/4)(t^2 - 1)| <= 1/4.
#pragma once

#include <optional>

#include "checker/single_channel/curve_proposal.hpp"

namespace veritrack::checker {

/// X* is within the distances of C, component by component.
struct InvariantCurve {
  CurveFamily family;
  Ball here;                                ///< the t of the frequency that was asked for: near 0
  std::array<Ball, kToneStates> distance;   ///< at every frequency of the family
  std::array<Ball, kToneStates> near_here;  ///< at t = here
};

/// The curve at `frequency` (rad/sample) and, unless half_width is 0, at all frequencies center + half_width
/// t, where `center` is a double in `frequency`. Nothing unless all contract by `rate`.
std::optional<InvariantCurve> establish_invariant_curve(const TrackerValues<Ball>& values,
                                                        const Ball& frequency, double half_width,
                                                        const Ball& rate);

/// The Taylor coefficients of b(phi) at phi = base + slope x: a column for each power of x.
Matrix waves(slong harmonics, const Ball& base, const Ball& slope, slong terms);

/// pi part / parts to pi (part + 1) / parts.
Ball part_of_period(std::size_t part, std::size_t parts);

}  // namespace veritrack::checker
