// The steady state of the single-channel tracker on a noise-free tone: an invariant curve over the phase, and
// the bias that it holds.
//
// With a tone of constant frequency omega the closed loop is a skew product, (phi, X) -> (phi + omega,
// G_phi(X)), pi-periodic in phi (single_channel_rotating_frame.hpp). Its steady state is not a fixed point
// but a curve X*(phi) with G_phi(X*(phi)) = X*(phi + omega). Its frequency component nu* is the error after
// all transients: it ripples with the phase, and its mean is the bias.
//
// What is verified. Given a trigonometric polynomial C(phi), cells I_i that cover a period, an invertible
// matrix V_i for each, and a radius R, let the tube be {(phi, C(phi) + V_i u) : phi in I_i, |u| <= R}.
// Suppose that for all i, all j whose cell meets I_i + omega modulo pi, and all points of the tube
//   (a)  |V_j^-1 (G_phi(C(phi)) - C(phi + omega))| <= rho,
//   (b)  |V_j^-1 DG_phi(X) V_i|_2 <= kappa < 1,
//   (c)  kappa R + rho <= R.
// Then the tube is mapped into itself and contains exactly one invariant curve, which is continuous and stays
// within rho / (1 - kappa) of C (in the same coordinates), and every start in the tube converges to it by the
// factor kappa a sample.
// Proof. For fixed phi the fibre {|u| <= R} is convex, so (b) bounds the distance of images by kappa times
// the distance, and with (a) and (c) the fibre over phi goes into that over phi + omega. Hence the graph
// transform, which maps a function phi -> X(phi) with values in the tube to phi + omega -> G_phi(X(phi)), is
// a contraction of the functions with values in the tube, complete in the supremum of |u|; it maps continuous
// functions to continuous ones, and C is one of them; its fixed point is X*. |X* - C| <= kappa |X* - C| +
// rho. QED
// For an interval of frequencies C depends on omega too, and (a) to (c) are verified for all of them at once.
//
// Without a leak {delta = nu = 0} is mapped into itself (a test checks this), so with a C whose components
// there are zero the graph transform keeps them zero: the error part of X* is exactly zero.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/verdict.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::single_channel {

/// The steady-state error of the frequency estimate, nu = estimate - true frequency, rad/sample.
struct SteadyStateBias {
  /// PROVED: the enclosures hold for the steady state of every start in a neighbourhood of the curve, and the
  /// tracker is locked on it: the estimate z stays within a quarter turn of the signal at every phase.
  /// UNDECIDED otherwise, with the reason.
  rigor::Verdict verdict = rigor::Verdict::undecided;
  std::string reason;
  rigor::Interval frequency;  ///< omega, rad/sample
  /// (1/pi) int_0^pi nu*(phi) dphi. It is also the mean over time along every trajectory when omega / pi is
  /// irrational (Weyl), as it is for every rational omega but 0.
  rigor::Interval mean_bias;
  rigor::Interval min_error;   ///< min over phi of nu*
  rigor::Interval max_error;   ///< max over phi of nu*
  std::optional<double> rate;  ///< kappa, an upper bound; none when the steady state is proved without a tube
  double distance = 0.0;       ///< rho / (1 - kappa), an upper bound
};

/// True only when the exact estimate, nu = 0, is an exponentially stable steady state for every design and
/// every frequency (rad/sample) in question, without a tube: no leak, q1, q2, r > 0, and a frequency between
/// 0 and pi, where the linear system that the exact estimate follows is uniformly observable and controllable
/// (docs/single-channel.md, section 2). Needs the upward rounding mode.
[[nodiscard]] bool settles_exactly(const trackers::ToneModel<rigor::Interval>& design,
                                   const rigor::Interval& frequency);

/// The bias for every design in `design` (q1, q2, r, epsilon at amplitude 1) and every omega in `frequency`
/// (rad/sample, in [0, pi]): a decimal's enclosure, or an interval of some thousandths, over which the
/// enclosures hold for each frequency. At most that many cells of phase
/// are tried. Where no tube is verified but settles_exactly, PROVED without a rate. Deterministic. Holds its
/// own rounding modes.
[[nodiscard]] SteadyStateBias steady_state_bias(const trackers::ToneModel<rigor::Interval>& design,
                                                const rigor::Interval& frequency,
                                                std::size_t most_cells = 2048);

}  // namespace veritrack::single_channel
