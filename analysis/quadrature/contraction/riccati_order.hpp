// The covariance of the quadrature tracker between two bounds, in the polar frame.
//
// One step maps P to U(-turn) Phi(P, rho) U(-turn)', Phi = update(F(rho) P F(rho)' + Q). The update is
//     Phi(P) = min over K of (I - K H) Pp (I - K H)' + r K K',   Pp = F P F' + Q,
// in the Loewner order (the minimum is attained at the Kalman gain, where S = H Pp H' + r I > 0), hence
// monotone: P_lo <= P <= P_hi implies Phi(P_lo) <= Phi(P) <= Phi(P_hi). And the gain is K = Phi(P) H' / r, so
// that bounds on Phi are bounds on the gain.
#pragma once

#include <vector>

#include "analysis/rigor/interval.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// A covariance without correlation between the amplitude and the rest: P12 = P13 = 0.
template <typename Scalar>
struct BlockCovariance {
  Scalar p11, p22, p23, p33;
};

/// Phi(P, rho), with the gain that led there.
template <typename Scalar>
struct BlockUpdate {
  BlockCovariance<Scalar> filtered;
  Scalar gain_amplitude;  ///< K11
  Scalar gain_phase;      ///< K22
  Scalar gain_frequency;  ///< K32, rad/sample
  /// 1 - K11 and 1 - K22: the factors of an error.
  Scalar rest_amplitude, rest_phase;
};

/// One prediction with F(rho) and one update, epsilon = 0; the frame of the prediction is kept. Block
/// covariances stay block covariances.
template <typename Scalar>
[[nodiscard]] BlockUpdate<Scalar> riccati_update(const BlockCovariance<Scalar>& p, const Scalar& rho,
                                                 const trackers::ToneModel<Scalar>& design) {
  using trackers::detail::square;
  const Scalar p11 = p.p11 + design.q1;
  const Scalar p23 = p.p23 + rho * p.p33;
  const Scalar p22 = p.p22 + rho * (p.p23 + p23) + design.q1;
  const Scalar over_s1 = Scalar(1.0) / (p11 + design.r);
  const Scalar over_s2 = Scalar(1.0) / (p22 + design.r);
  // K = 1 - r/S has fewer repeated variables than P/S.
  const Scalar rest1 = design.r * over_s1;
  const Scalar rest2 = design.r * over_s2;
  const Scalar gain1 = Scalar(1.0) - rest1;
  const Scalar gain2 = Scalar(1.0) - rest2;
  const Scalar gain3 = p23 * over_s2;
  return {{design.r * gain1, design.r * gain2, design.r * gain3, p.p33 + design.q2 - square(p23) * over_s2},
          gain1,
          gain2,
          gain3,
          rest1,
          rest2};
}

/// A range of |z| with a bound on the |tangent| of the turns that happen there.
struct TurnBound {
  rigor::Interval rho;
  double tangent = 0.0;
};

/// True only when (1 + room) P_lo <= U Phi(P_lo, rho) U' and U Phi(P_hi, rho) U' <= (1 - room) P_hi for every
/// rho and every turn with |tan| <= tangent (and cosine > 0) of every element of `turns`, U =
/// diag(Rot(angle), 1). Then, by monotonicity, P_lo <= P <= P_hi is kept by every step with such a rho and
/// turn, even when something else then moves P by at most room * P_lo. Needs the upward mode.
[[nodiscard]] bool certainly_keeps_covariance_between(const BlockCovariance<rigor::Interval>& lower,
                                                      const BlockCovariance<rigor::Interval>& upper,
                                                      const trackers::ToneModel<rigor::Interval>& design,
                                                      const std::vector<TurnBound>& turns,
                                                      double room = 0.0 VERITRACK_CALL_SITE);

}  // namespace veritrack::quadrature
