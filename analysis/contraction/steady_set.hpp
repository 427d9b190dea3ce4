// A set of errors and covariances around the steady state of a leaky tracker, at every frequency of a band.
#pragma once

#include <vector>

#include "analysis/contraction/steady_contraction.hpp"
#include "analysis/rigor/matrix.hpp"

namespace veritrack::contraction {

/// The sets Omega_s(omega) = {|T (e - e*(omega))| <= s} x {-s below <= P - P*(omega) <= s above}, 0 < s <= 1,
/// in the polar frame (trackers/quadrature_polar_frame.hpp) around the lock branch X*(omega) = (e*, P*),
/// amplitude 1. All entries are exact doubles.
///
/// When verify_steady_set has certified it over a band: while the frequency stays in the band, for every
/// noise |v| <= `noise` and slew |w| <= `slew`, a state of Omega_s with s in one of the ranges of `levels` is
/// followed by one of Omega_(rate s) with the rate of that range; a state of Omega_s with a smaller s, by one
/// of Omega_(lowest level).
struct SteadySet {
  rigor::Matrix<3> metric;         ///< T, upper triangular with a positive diagonal
  rigor::Matrix<3> below;          ///< symmetric
  rigor::Matrix<3> above;          ///< symmetric
  double noise = 0.0;              ///< V >= 0, relative to the amplitude
  double slew = 0.0;               ///< W >= 0, rad/sample per sample
  std::vector<LevelRange> levels;  ///< adjoining, the first one ends at 1
};

/// |T e| for every e in the box. Needs the upward mode.
[[nodiscard]] rigor::Interval metric_norm(const SteadySet& set, const rigor::IntervalVector<3>& error);

/// Bounds on |e_i - e*_i| over {|T (e - e*)| <= level}: amplitude, phase (rad), frequency (rad/sample). Needs
/// the upward mode.
[[nodiscard]] rigor::IntervalVector<3> error_bounds(const SteadySet& set, const rigor::Interval& level);

}  // namespace veritrack::contraction
