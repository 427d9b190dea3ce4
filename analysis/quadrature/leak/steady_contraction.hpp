// Does every step map one level of a set around the steady state into the next one? With a leak.
#pragma once

#include <cstdint>
#include <string>

#include "analysis/quadrature/leak/steady_order.hpp"

namespace veritrack::quadrature {

/// What the cells that cover a level say together.
struct SteadyContraction {
  bool proved = false;
  std::string reason;      ///< one sentence when not proved
  std::int64_t cells = 0;  ///< examined
};

/// What acts on the tracker.
struct SteadyDisturbance {
  rigor::Interval noise;  ///< |v| <= noise
  /// Upper bounds on how far slew and rounding carry e+ - e*, in the metric, and P+ - P*, as a share of its
  /// bounds.
  rigor::Interval motion, covariance_motion;
};

/// Covers all states of this level s by cells in (x, y), bisected until every step of theirs leads to the
/// level `next` = kappa s: |T (e+ - e*)| <= kappa s and -kappa s below <= P+ - P* <= kappa s above, kappa <=
/// 1. For the covariance it is enough to look at the images of the two bounds: P <= P* + s above implies
/// Phi(P, rho) <= Phi(P* + s above, rho), as the Riccati step is monotone for positive definite covariances
/// (riccati_order.hpp; the leak changes F only), and a turn keeps the order. Needs P* - s below > 0, and the
/// upward mode. Gives up after `most_cells`.
[[nodiscard]] SteadyContraction prove_contraction(const SteadySettings& settings, double level, double next,
                                                  const SteadyDisturbance& disturbance,
                                                  std::int64_t most_cells);

}  // namespace veritrack::quadrature
