// Do the assumed starts come into a set around the steady state? With a leak.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/quadrature/leak/steady_set.hpp"
#include "analysis/sets/contraction_question.hpp"
#include "analysis/sets/fixed_point_bias.hpp"

namespace veritrack::quadrature {

/// Bounds on the starts at the frequencies of a cell.
struct SteadyStart {
  /// An upper bound on the least level s such that Omega_s holds the starts, possibly above 1; nothing when
  /// the covariance is not certainly between the bounds of level 1.
  std::optional<double> level;
  bool reached = false;             ///< all starts come into Omega_1
  int samples = 0;                  ///< after at most this many samples
  double level_when_reached = 0.0;  ///< an upper bound
  double frequency_error = 0.0;     ///< upper bound on |frequency error| until then, rad/sample
  std::string failure;              ///< where they are not known to, as a part of a sentence
};

/// The bounds that are valid for all of them. Throws std::invalid_argument when there are none.
[[nodiscard]] SteadyStart joined(const std::vector<SteadyStart>& starts);

/// Starts are relative to the true signal: the errors of the question around it, with the question's start
/// covariances, without which none is reached. Where Omega_1 does not hold them they are followed, at a
/// constant frequency (slew zero) and with the noise of the set, until Omega_s with s <= 1/2 does
/// (capture.hpp). One for each cell, in their order, up to the first few that are not reached. Opens its own
/// rounding scope; deterministic.
[[nodiscard]] std::vector<SteadyStart> follow_to_steady_set(const sets::ContractionQuestion& question,
                                                            const std::vector<sets::BranchCell>& cells,
                                                            const SteadySet& set);

/// A level up to 1 of a ladder at which the deviation of the covariance from P* lies between the bounds of
/// the set; nothing when there is none. Needs the upward mode.
[[nodiscard]] std::optional<double> covariance_level(const rigor::IntervalMatrix<3>& deviation,
                                                     const SteadySet& set);
/// The same of all deviations between two in the Loewner order.
[[nodiscard]] std::optional<double> covariance_level(const rigor::IntervalMatrix<3>& least,
                                                     const rigor::IntervalMatrix<3>& largest,
                                                     const SteadySet& set);

}  // namespace veritrack::quadrature
