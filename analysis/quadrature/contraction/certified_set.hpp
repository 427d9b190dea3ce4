// CertifiedSet: an invariant set of errors and covariances of the quadrature tracker.
#pragma once

#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::quadrature {

/// The set Omega = {|T e|_2 <= R} x {P_lo <= P <= P_hi} in the polar frame (trackers/quadrature_polar_frame
/// .hpp): e = (amplitude, phase, frequency error), P the covariance in the frame of the estimated phase, <=
/// the Loewner order. All entries are exact doubles: what is certified is the set that these doubles
/// describe. Signals have amplitude 1.
///
/// When verify_certified_set has certified it: starts in Omega stay in Omega for ever, for every noise |v| <=
/// `noise` and slew |w| <= `slew`, and every step of the program in double precision satisfies
///     |T e+| <= sqrt(rate^2 |T e|^2 + noise_gain^2 |v|^2 + slew_gain^2 w^2) + error_rounding.
struct CertifiedSet {
  rigor::Matrix<3> metric;            ///< T = [[t_a, 0, 0], [0, t22, t23], [0, 0, t33]], invertible
  double radius = 0.0;                ///< R > 0
  rigor::Matrix<3> covariance_lower;  ///< P_lo, symmetric, P12 = P13 = 0
  rigor::Matrix<3> covariance_upper;  ///< P_hi, symmetric, P12 = P13 = 0
  double noise = 0.0;                 ///< V >= 0, relative to the amplitude
  double slew = 0.0;                  ///< W >= 0, rad/sample per sample
  double rate = 1.0;                  ///< kappa, an upper bound
  double noise_gain = 0.0;            ///< L_v; without meaning when there is no noise
  double slew_gain = 0.0;             ///< L_w; without meaning when there is no slew
  /// Bounds on what rounding adds to |T e| in a step, and to P as a share of P_lo, up or down in the Loewner
  /// order (docs/rounding.md).
  double error_rounding = 0.0;
  double covariance_rounding = 0.0;
};

/// |T e|_2 for every e in the box; empty when an operand is not finite. Needs the upward mode.
[[nodiscard]] rigor::Interval metric_norm(const CertifiedSet& set, const rigor::IntervalVector<3>& error);

/// True only when every (e, P) of the box lies in the set: |T e| <= R, and P - P_lo and P_hi - P positive
/// definite for every symmetric P in `covariance`. The phase error is used unchanged; a caller who knows it
/// modulo 2 pi only subtracts the multiple. Needs the upward mode.
[[nodiscard]] bool certainly_contains(const CertifiedSet& set, const rigor::IntervalVector<3>& error,
                                      const rigor::IntervalMatrix<3>& covariance VERITRACK_CALL_SITE);

/// Bounds on |amplitude error|, |phase error| (rad) and |frequency error| (rad/sample) over {|T e|_2 <=
/// `level`}: `level` times the lengths of the rows of T^-1. Empty when T is not certainly invertible. Needs
/// the upward mode.
[[nodiscard]] rigor::IntervalVector<3> error_bounds(const CertifiedSet& set, const rigor::Interval& level);

/// An upper bound on |T e| after a step from |T e| <= `level`, for |v| <= `noise` and |w| <= `slew`, which
/// must not exceed those of the set. Needs the upward mode.
[[nodiscard]] rigor::Interval next_level(const CertifiedSet& set, const rigor::Interval& level,
                                         const rigor::Interval& noise, const rigor::Interval& slew);

/// A bound on the limit of |T e(k)|, for such noise and slew: the fixed point u of next_level. Needs the
/// upward mode.
[[nodiscard]] rigor::Interval ultimate_level(const CertifiedSet& set, const rigor::Interval& noise,
                                             const rigor::Interval& slew);

}  // namespace veritrack::quadrature
