// One step of an extended Kalman filter in the coordinates of a tube that bounds its covariance, over a cell
// of phases and frequencies.
//
// With the updated covariance P+ the estimate is x+ = x^ + P+ H' R^-1 (y - H x^ - h_0): affine in P+. And P+
// is monotone in P. So a tube has the estimate alone as its state, and bounds of the covariance beside it: if
// the covariance predicted for this sample is between low(phi) and high(phi), the updated one is between low+
// and high+, those of the bounds; nothing else is known about P+ (docs/model-proof.md, section 13).
#pragma once

#include <vector>

#include "analysis/model/step/tube_step.hpp"

namespace veritrack::model {

/// A question about a step.
struct FilterStepQuestion {
  double radius = 0.0;
  double noise = 0.0;           ///< V, signal units
  double slew = 0.0;            ///< W, rad/sample per sample
  bool with_covariance = true;  ///< also show that its bounds are kept
  double margin = 0.0;          ///< the slack that they must then leave: see RangeQuestion
};

/// A vector that is at least as long as F over a cell, for every covariance between the bounds of the tube,
/// as ball models in xi/radius and v/noise. It is affine in v.
struct FilterStepOver {
  std::vector<rigor::BallModel> vector;  ///< empty when nothing is known
  rigor::Interval frequency_error;       ///< of h(C + U xi) - omega; empty when nothing is known
  bool is_known = false;                 ///< and, if asked, the bounds of the covariance are kept
};

/// For |xi| <= radius, |v| <= noise and the slew, both stretched as in the bounds below. `of_gaussian`: for
/// Gaussian noise, 2 L (deviation/noise)^2, for which the multiplier of the vector is chosen; 0: for bounded
/// noise. `store`: of this model and tube, or none. Needs the upward rounding mode, and a scope of ball
/// models with as many components as there are states of the estimate, and disturbances as there are samples
/// (noise > 0) and one more (slew > 0). Throws std::invalid_argument when sizes do not fit.
[[nodiscard]] FilterStepOver filter_step_over(const TrackerModel& model, const Tube& tube,
                                              const TubeCell& cell, const FilterStepQuestion& question,
                                              double of_gaussian = 0.0, PlaceStore* store = nullptr);

/// Bounds over a cell of |F| for |xi| <= scale radius, for each of the scales, all |v| <= noise, a frequency
/// that moves by at most the slew, and all covariances between the bounds of the tube; with
/// `with_covariance`, they are known only where the bounds are shown to be bounds again at the next phase,
/// for all |xi| <= radius. Sets its own rounding mode. Throws std::invalid_argument when sizes do not fit.
[[nodiscard]] StepBounds bound_filter_step(const TrackerModel& model, const Tube& tube, const TubeCell& cell,
                                           const FilterStepQuestion& question,
                                           const std::vector<double>& scales, PlaceStore* store = nullptr);

/// A question about the bounds of a covariance, over a cell.
struct RangeQuestion {
  double radius = 0.0;  ///< of the estimate in the tube
  /// From one sample to the next they leave this share of themselves: F Phi(high) F' + Q < (1 - margin)
  /// high+, F Phi(low) F' + Q > low+/(1 - margin).
  double margin = 0.0;
  /// The same for c high and low/c in place of high and low, on both sides, for all c from 1 to this.
  double ratio = 1.0;
};

/// Whether the bounds are a nonempty range of covariances in the cell, and bounds again at the next phase,
/// for all |xi| <= radius. Sets its own rounding mode. Throws std::invalid_argument when sizes do not fit.
[[nodiscard]] bool keeps_range(const TrackerModel& model, const Tube& tube, const TubeCell& cell,
                               const RangeQuestion& question);

}  // namespace veritrack::model
