// The drift of an exponential of a tube's level under Gaussian noise (docs/model-proof.md, section 11).
//
// With the level l = |U^-1 (X - C)| of a state and W = exp(L l^2/R^2), the expectation of W after a step is
// at most kappa W + c0 for all states in the tube of radius R, whatever their place: then the probability
// that a state leaves the tube is known, by the inequality of Doob and Ville.
#pragma once

#include <cstddef>
#include <string>

#include "analysis/model/step/cell_cover.hpp"
#include "analysis/model/step/tube_step.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::model {

/// A question about a tube.
struct DriftQuestion {
  double radius = 0.0;      ///< R
  double deviation = 0.0;   ///< of the noise in each sample, at most, signal units
  double most_noise = 0.0;  ///< V: longer errors, all samples together, count as a loss of lock; signal units
  double exponent = 0.0;    ///< L: W is exp(L) at the rim
  double factor = 1.0;      ///< kappa
  double constant = 0.0;    ///< c0
  /// At least 1: nonlinear terms count this many times, a little more, for a checker whose bounds are cruder.
  double room = 1.0;
  /// For a filter: also show that the bounds of the covariance are kept.
  bool with_covariance = true;
};

struct DriftResult {
  rigor::Verdict verdict = rigor::Verdict::undecided;  ///< PROVED or UNDECIDED
  std::string reason;                                  ///< why not PROVED
  std::size_t cells = 0;                               ///< that were needed
  rigor::Interval frequency_error;                     ///< PROVED: of h - omega in the tube, rad/sample
};

/// Whether E[W(X+); |v| <= V] <= kappa W(X) + c0 for every state X of the tube of radius R, at all phases and
/// all frequencies of the tube, for every noise that is sub-Gaussian with this deviation: E exp(u'v) <=
/// exp(deviation^2 |u|^2/2) for all u. Cells that fail are halved, up to the budget; the result does not
/// depend on the number of threads. UNDECIDED, with the reason, as for verify_level.
[[nodiscard]] DriftResult verify_drift(const TrackerModel& model, const Tube& tube,
                                       const DriftQuestion& question, const VerificationBudget& budget);

/// Whether the same is true at this many phases, by the same bounds over cells without width. Not evidence.
[[nodiscard]] bool drift_may_hold(const TrackerModel& model, const Tube& tube, const DriftQuestion& question,
                                  int phases);

}  // namespace veritrack::model
