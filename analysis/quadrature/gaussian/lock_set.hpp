// LockSet: a set of errors and covariances of the quadrature tracker that it leaves with a small probability
// only when the noise is Gaussian.
#pragma once

#include <array>

#include "analysis/quadrature/contraction/correction.hpp"
#include "analysis/quadrature/gaussian/level_covariance.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::quadrature {

/// In the frame of the true phase (trackers/rotating_frame.hpp): e = (Re delta, Im delta, nu), P the
/// covariance, signals of amplitude 1. The level of P is the least s >= 0 with lo(s) <= P <= hi(s) in the
/// Loewner order,
///     hi(s) = P_0 + s D_h,   lo(s) = (P_0^-1 + s D_l)^-1,
/// and the level of (e, P) is (|T e|^2 + gamma s^2)/2. The set is where that is at most `level`. All numbers
/// are exact doubles: what is certified is the set that they describe.
///
/// When verify_lock_set has certified it, W = exp(level of (e, P)) satisfies E[W(k+1) | k] <= decay W(k) +
/// drift wherever the level of (e(k), P(k)) is at most `level`: docs/gaussian.md, condition (4); and so it
/// does when the exact step is followed by a change that is small enough: lock_rounding.hpp.
struct LockSet {
  BlockMetric<double> metric;            ///< T, invertible
  LevelCovariance<double> centre;        ///< P_0 > 0
  LevelCovariance<double> spread_above;  ///< D_h > 0
  LevelCovariance<double> spread_below;  ///< D_l > 0
  double weight = 0.0;                   ///< gamma > 0
  double level = 0.0;                    ///< L > 0
  double decay = 0.0;                    ///< kappa, 0 < kappa < 1
  double drift = 0.0;                    ///< c_0 >= 0
  double noise_deviation = 0.0;  ///< sigma of each channel, relative to the amplitude, > 0: an upper bound
  double frequency_walk = 0.0;   ///< deviation of the frequency's step, rad/sample, >= 0: an upper bound
  /// With a leak. e_0, of which the errors are differences: e = (Re delta, Im delta, nu) - e_0.
  std::array<double, 3> bias{};
  /// The signal's frequencies for which this is said, rad/sample; of no effect without a leak.
  double lowest_frequency = 0.0, highest_frequency = 0.0;
};

/// eta of docs/gaussian.md, section 7: the room of the inequality for rounding.
inline constexpr double kRoundingRoom = 0x1p-14;

/// As a 3x3 matrix.
[[nodiscard]] rigor::IntervalMatrix<3> enclosed(const LevelCovariance<double>& p);

/// hi(s) and lo(s). Need the upward mode.
[[nodiscard]] rigor::IntervalMatrix<3> upper_covariance(const LockSet& set, const rigor::Interval& s);
[[nodiscard]] rigor::IntervalMatrix<3> lower_covariance(const LockSet& set, const rigor::Interval& s);

/// An upper bound on |nu| in the set, rad/sample: |e_03| + sqrt(2 L)/t33. Needs the upward mode.
[[nodiscard]] rigor::Interval largest_frequency_error(const LockSet& set);

}  // namespace veritrack::quadrature
