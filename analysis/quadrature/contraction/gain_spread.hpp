// The range of the gain while the covariance stays between two bounds: its mean, and the largest deviation
// from it.
#pragma once

#include "analysis/quadrature/contraction/riccati_order.hpp"
#include "analysis/rigor/dual.hpp"

namespace veritrack::quadrature {

/// Phi lies between Phi_lo = riccati_update(P_lo) and Phi_hi, and K = Phi H' / r.
template <typename Scalar>
struct GainSpread {
  BlockCovariance<Scalar> spread;                     ///< (Phi_hi - Phi_lo)/2
  Scalar mean_amplitude, mean_phase, mean_frequency;  ///< of the gains K11, K22, K32 of the two bounds
  Scalar rest_amplitude, rest_phase;                  ///< 1 - mean of K11 and K22
  Scalar largest_amplitude, largest_phase;            ///< K11 and K22 of the upper bound
};

/// The spread at |z| = rho.
template <typename Scalar>
[[nodiscard]] GainSpread<Scalar> gain_spread(const BlockCovariance<Scalar>& lower,
                                             const BlockCovariance<Scalar>& upper, const Scalar& rho,
                                             const trackers::ToneModel<Scalar>& design) {
  const Scalar half(0.5);
  const BlockUpdate<Scalar> low = riccati_update(lower, rho, design);
  const BlockUpdate<Scalar> high = riccati_update(upper, rho, design);
  return {{half * (high.filtered.p11 - low.filtered.p11), half * (high.filtered.p22 - low.filtered.p22),
           half * (high.filtered.p23 - low.filtered.p23), half * (high.filtered.p33 - low.filtered.p33)},
          half * (low.gain_amplitude + high.gain_amplitude),
          half * (low.gain_phase + high.gain_phase),
          half * (low.gain_frequency + high.gain_frequency),
          half * (low.rest_amplitude + high.rest_amplitude),
          half * (low.rest_phase + high.rest_phase),
          high.gain_amplitude,
          high.gain_phase};
}

/// The spread with its derivatives: one derivative, with respect to rho, and the chain rule. Needs the upward
/// mode.
template <typename Set, int N>
[[nodiscard]] GainSpread<rigor::Dual<Set, N>> gain_spread(const BlockCovariance<Set>& lower,
                                                          const BlockCovariance<Set>& upper,
                                                          const rigor::Dual<Set, N>& rho,
                                                          const trackers::ToneModel<Set>& design) {
  using Slope = rigor::Dual<Set, 1>;
  const auto constant = [](const BlockCovariance<Set>& p) {
    return BlockCovariance<Slope>{Slope(p.p11), Slope(p.p22), Slope(p.p23), Slope(p.p33)};
  };
  const trackers::ToneModel<Slope> constants{Slope(design.q1), Slope(design.q2), Slope(design.r),
                                             Slope(design.epsilon)};
  const GainSpread<Slope> f =
      gain_spread<Slope>(constant(lower), constant(upper), Slope(rho.value(), {Set(1.0)}), constants);
  const auto at = [&](const Slope& slope) { return rho.chain(slope.value(), slope.derivative(0)); };
  return {{at(f.spread.p11), at(f.spread.p22), at(f.spread.p23), at(f.spread.p33)},
          at(f.mean_amplitude),
          at(f.mean_phase),
          at(f.mean_frequency),
          at(f.rest_amplitude),
          at(f.rest_phase),
          at(f.largest_amplitude),
          at(f.largest_phase)};
}

}  // namespace veritrack::quadrature
