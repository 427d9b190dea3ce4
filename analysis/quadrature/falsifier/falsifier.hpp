// Falsification: an honest attempt to break a certified set with the plain tracker. Proves nothing; a
// statement that it breaks is an alarm.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/quadrature/contraction/certified_set.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// How hard to try.
struct FalsifierOptions {
  int steps = 200;              ///< length of the sequences
  int search_evaluations = 40;  ///< of NLopt, for each family of periodic sequences
  int gradient_iterations = 3;  ///< for each horizon
  std::uint64_t seed = 20261121;
};

/// A start, and all inputs of the tracker from there: enough to repeat the run.
struct Attack {
  std::string structure;  ///< constant, alternating, resonant, turning, greedy, gradient; + search
  Eigen::Vector3d start_error = Eigen::Vector3d::Zero();       ///< amplitude, phase, frequency
  Eigen::Matrix3d start_covariance = Eigen::Matrix3d::Zero();  ///< in the frame of the estimated phase
  /// From step k to k+1: noise along and across the predicted phase (relative to the amplitude), slew
  /// (rad/sample per sample).
  std::vector<Eigen::Vector3d> inputs;
};

/// The largest frequency error found after the start, beside the certified bound.
struct WorstCase {
  Attack attack;
  double frequency_error = 0.0;  ///< its absolute value, rad/sample
  int step = 0;                  ///< at which it occurs, >= 1
  double bound = 0.0;            ///< certified, rad/sample
  /// frequency_error / bound: 1 when the bound is attained. Sampled, not proved; zero when the bound is zero.
  [[nodiscard]] double tightness() const { return bound > 0.0 ? frequency_error / bound : 0.0; }
};

/// A run that contradicts what was certified.
struct Alarm {
  Attack attack;
  std::string statement;  ///< which one, with the numbers
  int step = 0;
};

/// The result.
struct Falsification {
  WorstCase from_rim;          ///< starts |T e| = R; the bound is that of the set, R |e3' T^-1|
  WorstCase from_zero;         ///< starts e = 0; the bound is the ultimate one, u |e3' T^-1|
  double largest_level = 0.0;  ///< the largest |T e| / R after the start
  std::optional<Alarm> alarm;  ///< the first; a PROVED set must give none
  std::int64_t runs = 0;
};

/// Looks for starts in the set and for noise and slew within its limits that make the frequency error of
/// QuadratureEkf<double> large: sequences constant, alternating, resonant with the loop and turning, refined
/// by NLopt; greedy ones, which push |T e| out at each step; and ones that maximise the linearised |T e| or
/// frequency error at a horizon, over start error, start covariance, noise and slew at once, repeated. Every
/// step of every run is compared with all that is certified: |T e+|^2 <= rate^2 |T e|^2 + L_v^2 |v|^2 + L_w^2
/// w^2, |T e| <= R, and the bounds on the covariance, with room for rounding only (about 1e-7).
/// Deterministic. The set is taken at its word: gains included, as verify_certified_set returns them. epsilon
/// must be zero. Opens its own NearestRounding scope. Throws std::invalid_argument when steps < 1 or the set
/// is not one (covariance bounds not in order, metric not invertible, a number not finite).
[[nodiscard]] Falsification try_to_break(const CertifiedSet& set, const trackers::ToneModel<double>& design,
                                         const FalsifierOptions& options = {});

}  // namespace veritrack::quadrature
