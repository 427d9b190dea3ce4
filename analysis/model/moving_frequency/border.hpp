// From the tube of one cell of frequencies into that of the next, for a frequency that moves.
//
// Both tubes exist at the border of two cells. A state C_a + U_a xi is, in the coordinates of the tube b,
//   U_b^-1 (C_a - C_b + U_a xi) = xi + U_b^-1 (C_a - C_b + (U_a - U_b) xi)
// at the same phase and frequency. If that is at most R_b long for all |xi| <= R_a', a state that is at or
// below the level R_a' of the tube a is at or below the level R_b of the tube b (docs/model-proof.md).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/model/step/cell_cover.hpp"
#include "analysis/model/step/tube_step.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::model {

/// A question about a border.
struct BorderQuestion {
  /// R_a': the level, in the tube that the state leaves, at or below which it is after a step.
  double from_radius = 0.0;
  double to_radius = 0.0;  ///< R_b: the level in the next tube
  /// W: the frequency is within this of the border, rad/sample.
  double slew = 0.0;
  /// The same for r R_a' and r R_b, all r from this to 1.
  double least_scale = 1.0;
  /// For filters: also show that the bounds of the covariance, narrower by this share of themselves, are
  /// between those of the next tube. Empty: not asked.
  std::optional<double> covariance_margin = {};
};

struct BorderResult {
  rigor::Verdict verdict = rigor::Verdict::undecided;  ///< PROVED or UNDECIDED
  std::string reason;                                  ///< why not PROVED
  std::size_t cells = 0;                               ///< that were needed
  /// PROVED: the levels in the next tube are at most this multiple of r R_b.
  double largest = 0.0;
  TubeCell worst_cell;  ///< UNDECIDED: where it failed; z in [-1, 1] is the place in the strip
};

/// Whether, for all phases and all frequencies within W of the border, a state at a level up to r R_a' of the
/// tube `from` is at or below the level r R_b of the tube `to`, for all r from least_scale to 1. (The bound
/// is convex in r, as that of verify_level: two ends decide.) The border is the end of the lower tube's cell
/// and the beginning of the upper one's: all frequencies between them when they differ. Each cell must
/// reach at least W beyond the other: then no step passes a whole cell. UNDECIDED when the tubes do not turn
/// alike, angles included: curves that are 2 pi apart do not fit. Throws std::invalid_argument when sizes do
/// not fit.
[[nodiscard]] BorderResult verify_border(const TrackerModel& model, const Tube& from, const Tube& to,
                                         const BorderQuestion& question, const VerificationBudget& budget);

/// The bounds over a part of the strip, for each scale: of the length of U_b^-1 (C_a - C_b + scale R_a' U_a
/// xi) for |xi| <= 1; `frequency_error` is not used. z in [-1, 1] of the cell is the place in the strip.
/// Throws std::invalid_argument when sizes do not fit.
[[nodiscard]] StepBounds bound_border(const TrackerModel& model, const Tube& from, const Tube& to,
                                      const TubeCell& cell, const BorderQuestion& question,
                                      const std::vector<double>& scales);

}  // namespace veritrack::model
