// A question about a tracker over a band: its sets for starts, for the assumed noise and slew, and for the
// most noise or slew that it tolerates.
#pragma once

#include <optional>
#include <vector>

#include "analysis/model/gain/loop_rounding.hpp"
#include "analysis/model/set/amplitude_parts.hpp"
#include "analysis/model/set/searched_band.hpp"
#include "analysis/model/set/tube_set.hpp"
#include "analysis/rigor/interval.hpp"
#include "analysis/search/deadline.hpp"

namespace veritrack::model {

/// The tracker on its tone, the assumptions, and the requested sets.
struct SetQuestion {
  TrackedTone tone;      ///< for proposals
  TrackerModel tracker;  ///< for proofs
  /// For an amplitude that is constant and somewhere in the range of `tracker`; otherwise empty.
  ToneAtAmplitude tone_at = {};
  SearchedBand band = {};           ///< not empty
  rigor::Interval whole_band = {};  ///< as it is assumed, rad/sample
  /// The signal is the tone alone, and nothing is asked that only tubes answer (a start that is captured).
  bool allows_gains = false;
  /// Nothing is asked that only tubes answer, the amplitude is one number, and there is no filter.
  bool allows_phase_gains = false;
  RoundingOfStep rounding = {};  ///< of the program that runs; empty: exact arithmetic
  /// The angle of the samples as that program has it is off by up to this, rad: with an arc tangent of its
  /// own.
  double turned = 0.0;
  double noise = 0.0;                            ///< at most, signal units
  double slew = 0.0;                             ///< at most, rad/sample per sample
  std::vector<rigor::Interval> deviations = {};  ///< of the assumed starts from the curve, one for each state
  bool assumes_start = false;  ///< deviations of starts are assumed: shapes are made for them
  /// The frequency error is to be less, rad/sample.
  std::optional<rigor::Interval> required_error = {};
  bool largest_noise = false;     ///< the most noise that is tolerated
  bool largest_slew = false;      ///< the most slew, without noise
  bool reach_of_assumed = false;  ///< by gains: the reach with the assumed noise and slew
  bool is_thorough = false;  ///< also the disturbance that each cell tolerates, and the error expected to
                             ///< first order
  /// The search stops there; required sets are searched for first.
  search::Deadline deadline = {};

  [[nodiscard]] bool is_disturbed() const { return noise > 0.0 || slew > 0.0; }
};

/// The names of sets.
inline constexpr const char* kStarts = "starts";
inline constexpr const char* kAssumed = "assumed";
inline constexpr const char* kLargestNoise = "noise";
inline constexpr const char* kLargestSlew = "slew";

/// The searches for the sets of a question, in order.
[[nodiscard]] std::vector<SetTask> tasks_of(const SetQuestion& question);

}  // namespace veritrack::model
