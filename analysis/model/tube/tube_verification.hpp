// Is a tube of a given radius never left?
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "analysis/model/step/cell_cover.hpp"
#include "analysis/model/step/tube_step.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::model {

/// A question about a radius.
struct LevelQuestion {
  double radius = 0.0;  ///< R
  double noise = 0.0;   ///< V: |v| <= V, signal units
  /// Every radius from `least_scale` R to R shrinks to at most `shrinking` of itself in a step; 1: none may
  /// grow.
  double least_scale = 1.0;
  double shrinking = 1.0;
  /// W: from one sample to the next the frequency moves by at most this, rad/sample.
  double slew = 0.0;
  /// For a filter: also show that the bounds of the covariance are kept. It is enough to do so for the
  /// largest radius.
  bool with_covariance = true;
  /// They must then leave this share of themselves at every step.
  double covariance_margin = 0.0;
};

struct LevelResult {
  rigor::Verdict verdict = rigor::Verdict::undecided;  ///< PROVED or UNDECIDED
  std::string reason;                                  ///< why not PROVED
  std::size_t cells = 0;                               ///< that were needed
  /// PROVED: of h - omega in the tube of radius R, rad/sample.
  rigor::Interval frequency_error;
  TubeCell worst_cell;  ///< UNDECIDED: where it failed
};

/// Whether |F| <= shrinking r for all |xi| <= r, all r from least_scale R to R and all |v| <= V, for all
/// phases and all frequencies of the tube: then a state of level r is at level shrinking r or below after the
/// next sample, and so on; with a slew, as long as the frequency stays in the tube's cell. (The bound for
/// |xi| <= scale R is convex in the scale, because coefficients of degree a are multiplied by scale^a and the
/// error is kept: two ends decide.) Cells that fail are halved, up to the budget; the result does not depend
/// on the number of threads. UNDECIDED, with the reason, when the recursion does not know its angles modulo 2
/// pi only, when the signal is not 2 pi-periodic in its phase, and when a bound is missing somewhere.
/// `store`: of this model and tube, or none.
[[nodiscard]] LevelResult verify_level(const TrackerModel& model, const Tube& tube,
                                       const LevelQuestion& question, const VerificationBudget& budget,
                                       PlaceStore* store = nullptr);

/// The reason why statements over phases from 0 to 2 pi do not cover all phases; empty when they do.
[[nodiscard]] std::string objection_to_phases(const TrackerModel& model, const Tube& tube);

/// "at phases about 0.25 of a turn and frequencies about 0.3 rad/sample".
[[nodiscard]] std::string place_of_failure(const Tube& tube, const TubeCell& cell);

/// The largest |F|/R at points of the tube, by the bounds of verify_level over cells without width, at this
/// many phases: the best that a verification could prove for this radius, noise and slew. Not evidence;
/// infinity when nothing is known somewhere.
[[nodiscard]] double sampled_growth(const TrackerModel& model, const Tube& tube,
                                    const LevelQuestion& question, int phases);

/// Whether that is at most `most`: the first point at which it is not decides.
[[nodiscard]] bool may_shrink(const TrackerModel& model, const Tube& tube, const LevelQuestion& question,
                              int phases, double most, PlaceStore* store = nullptr);

/// Approximately the largest |F| over scale radius, at the radius and at its least scale, in some of the
/// cells of a grid. For proposals; proves nothing. Infinity when nothing is known.
[[nodiscard]] double growth_on_grid(const TrackerModel& model, const Tube& tube,
                                    const LevelQuestion& question, const VerificationBudget& grid,
                                    PlaceStore* store = nullptr);

/// The coarsest grid of at most `most` cells, from `grid` on, in whose cells a step shrinks as asked, judged
/// by some of them; empty where it has to be finer, and after the deadline of the grid. A verification that
/// begins too coarse costs three times as much. For proposals; proves nothing.
[[nodiscard]] std::optional<VerificationBudget> coarsest_grid(const TrackerModel& model, const Tube& tube,
                                                              const LevelQuestion& question,
                                                              VerificationBudget grid, int most,
                                                              PlaceStore* store = nullptr);

}  // namespace veritrack::model
