// The effect of the program's rounding on one step of a certified set without a leak (docs/rounding.md).
#pragma once

#include "analysis/quadrature/contraction/certified_set.hpp"
#include "analysis/quadrature/rounding/step_rounding.hpp"

namespace veritrack::quadrature {

/// The program's step is the exact step, followed by a change of e by at most `error` in |T e| and of P by at
/// most `covariance` P_lo, up or down in the Loewner order.
struct SetRounding {
  double error = 0.0;
  double covariance = 0.0;
};

/// The bounds also cover the set shifted by this many turns in the frequency error, in which lost starts end.
inline constexpr int kMostTurns = 3;

/// From any state of the set, if the exact step stays in it, for noise of at most that of the set. Infinite
/// when it cannot be bounded. Needs the upward mode.
[[nodiscard]] SetRounding set_rounding(const trackers::ToneModel<rigor::Interval>& design,
                                       const TrackedSignal& signal, const CertifiedSet& set);

/// The difference in polar coordinates, of a state with |z| >= least_z, |P_zz| <= largest_zz (spectral norm)
/// and |P_z3| <= largest_z3 in the exact step: the covariance is then seen from another phase.
struct PolarDifference {
  rigor::IntervalVector<3> error;             ///< symmetric boxes: amplitude, phase (rad), frequency error
  double p_zz = 0.0, p_z3 = 0.0, p_33 = 0.0;  ///< as in StateDifference
};
[[nodiscard]] PolarDifference polar_difference(const StateDifference& difference,
                                               const rigor::Interval& least_z,
                                               const rigor::Interval& largest_zz,
                                               const rigor::Interval& largest_z3);

/// A number mu, at most twice the necessary one, such that every symmetric D with blocks within these bounds
/// satisfies -mu P <= D <= mu P; infinite when P is not certainly positive definite. Needs the upward mode.
[[nodiscard]] double share_of(const rigor::IntervalMatrix<3>& p, const PolarDifference& difference);

}  // namespace veritrack::quadrature
