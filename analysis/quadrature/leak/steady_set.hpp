// A set of errors and covariances around the steady state of a leaky tracker, at every frequency of a band.
#pragma once

#include <vector>

#include "analysis/quadrature/leak/steady_gain.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::quadrature {

/// The sets Omega_s(omega) = {|T (e - e*(omega))| <= s} x {-s below <= P - P*(omega) <= s above}, 0 < s <= 1,
/// in the polar frame (trackers/quadrature/quadrature_polar_frame.hpp) around the lock branch X*(omega) =
/// (e*, P*), amplitude 1. All entries are exact doubles.
///
/// When verify_steady_set has certified it over a band: while the frequency stays in the band, for every
/// noise |v| <= `noise` and slew |w| <= `slew`, a state of Omega_s, s one of `levels`, is followed by one of
/// Omega_(next level), and in the last level by one of the same level.
struct SteadySet {
  rigor::Matrix<3> metric;     ///< T, upper triangular with a positive diagonal
  rigor::Matrix<3> below;      ///< symmetric
  rigor::Matrix<3> above;      ///< symmetric
  double noise = 0.0;          ///< V >= 0, relative to the amplitude
  double slew = 0.0;           ///< W >= 0, rad/sample per sample
  std::vector<double> levels;  ///< falling from 1, positive
};

/// |T e| for every e in the box. Needs the upward mode.
[[nodiscard]] rigor::Interval metric_norm(const SteadySet& set, const rigor::IntervalVector<3>& error);

/// Bounds on |e_i - e*_i| over {|T (e - e*)| <= level}: amplitude, phase (rad), frequency (rad/sample). Needs
/// the upward mode.
[[nodiscard]] rigor::IntervalVector<3> error_bounds(const SteadySet& set, const rigor::Interval& level);

/// A symmetric matrix of doubles by its upper triangle.
[[nodiscard]] Symmetric<rigor::Interval> to_symmetric(const rigor::Matrix<3>& p);

}  // namespace veritrack::quadrature
