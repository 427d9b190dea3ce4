// From a tube of a filter into one for the long run, whose bounds of the covariance are narrower.
//
// Both are tubes of the same frequencies. Estimates stay at the lowest level of the first one, and the
// covariance stays between its bounds low_0 and high_0, which are at most c times as wide: high_0 <= c
// high_1, low_0 >= low_1/c. If high_1 and low_1 are kept with a margin for these estimates, and so are c
// high_1 and low_1/c for every c > 1, then c becomes (1 - margin) c at every sample, and the covariance is
// between low_1 and high_1 when c is 1 (docs/model-proof.md, section 13).
#pragma once

#include "analysis/model/step/cell_cover.hpp"
#include "analysis/model/step/tube_step.hpp"

namespace veritrack::model {

/// The entry into a tube in the long run.
struct LongRunEntry {
  double margin = 0.0;  ///< of its bounds of the covariance: see RangeQuestion
  double ratio = 1.0;   ///< c at the beginning

  /// An upper bound on the number of samples after which the covariance is between the bounds. Needs the
  /// upward rounding mode.
  [[nodiscard]] double samples() const;
};

/// Whether, for all phases and frequencies, states at or below the level `radius` of the tube `from` are at
/// or below the level `into_radius` of the tube `into` of the same frequencies, and the bounds of the
/// covariance are as above. Throws std::invalid_argument when sizes do not fit.
[[nodiscard]] CoverResult verify_long_run_entry(const TrackerModel& model, const Tube& from, double radius,
                                                const Tube& into, double into_radius,
                                                const LongRunEntry& entry, const VerificationBudget& budget);

/// The largest levels in `into`, and the ratio, at this many phases and three frequencies. Not evidence.
struct SampledEntry {
  double level = 0.0;
  double ratio = 1.0;
};
[[nodiscard]] SampledEntry sampled_long_run_entry(const Tube& from, double radius, const Tube& into,
                                                  int phases);

}  // namespace veritrack::model
