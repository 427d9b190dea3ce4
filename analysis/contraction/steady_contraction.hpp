// Does every step of a set around the steady state lead to a lower level of it? With a leak.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/contraction/steady_bounds.hpp"
#include "analysis/rigor/dual.hpp"

namespace veritrack::contraction {

/// A range of levels with the rate that is to be proved for it.
struct LevelRange {
  double low = 0.0, high = 1.0;  ///< 0 < low <= high
  double rate = 1.0;             ///< kappa <= 1
};

/// What the cells that cover a range of levels say together.
struct SteadyContraction {
  bool proved = false;
  std::string reason;       ///< one sentence when not proved
  double noise_gain = 0.0;  ///< L_v, an upper bound
  std::int64_t cells = 0;   ///< examined
};

/// Differentiated in s, x, y, in where z lies across the steady one, and in the frequency.
using SteadySlope = rigor::Dual<rigor::Interval, 5>;

/// The setting of a cell of frequencies: over all of it, at its middle, and with derivatives.
struct SteadySettings {
  SteadySetting<rigor::Interval> over_cell, at_middle;
  SteadySetting<SteadySlope> slopes;
  rigor::Interval frequencies;  ///< about the middle, rad/sample
};

/// What acts on the tracker.
struct SteadyDisturbance {
  rigor::Interval noise;  ///< |v| <= noise
  /// Upper bounds on how far the slew carries e+ - e*, in the metric, and P+ - P*, as a share of its bounds.
  rigor::Interval motion, covariance_motion;
};

/// Covers all states of the levels in `range` by cells in (s, x, y), bisected until every step of theirs
/// leads to a level of at most kappa s: |T (e+ - e*)| <= kappa s and -kappa s below <= P+ - P* <= kappa s
/// above. For the covariance it is enough to look at the images of the two bounds: P <= P* + s above implies
/// Phi(P, rho) <= Phi(P* + s above, rho), as the Riccati step is monotone for positive definite covariances
/// (riccati_order.hpp; the leak changes F only), and a turn keeps the order. Needs P* - s below > 0, and the
/// upward mode.
[[nodiscard]] SteadyContraction prove_contraction(const SteadySettings& settings, const LevelRange& range,
                                                  const SteadyDisturbance& disturbance);

}  // namespace veritrack::contraction
