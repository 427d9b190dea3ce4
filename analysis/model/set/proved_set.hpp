// The consequences of a set of tubes: bounds of the frequency error, bias, ripple and reach.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "analysis/model/set/frequency_slices.hpp"
#include "analysis/model/set/tube_set.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// A set of tubes over the band, or a part of it, and its consequences there. Bounds are a thousandth wider,
/// for a checker whose bounds are cruder. Infinite, or empty, where nothing is known.
struct ProvedSet {
  TubeSet tubes;
  /// By which proof. Without tubes `tubes` has only their name and the disturbances.
  enum class Proof { tubes, gains, averages } proof = Proof::tubes;
  double frequency_error = INFINITY;  ///< of level R_0, at most, rad/sample
  double half_distance = 0.0;         ///< to the next false lock (false_lock.hpp), rad/sample
  double settled_error = INFINITY;    ///< of level R_m, at most, rad/sample
  double reach = 0.0;                 ///< at least, rad/sample
  double start_share = INFINITY;      ///< the level of the assumed starts over R_0, at most
  rigor::Interval bias;               ///< contains the mean over the phase, without noise, at level R_m
  double ripple = INFINITY;           ///< at most, likewise

  /// For the whole band.
  [[nodiscard]] bool is_proved() const { return tubes.is_complete; }
  /// For a part of it only: `tubes.part`.
  [[nodiscard]] bool has_part() const { return !tubes.is_complete && !tubes.tubes.empty(); }
  [[nodiscard]] bool is_without_tubes() const { return proof != Proof::tubes; }
};

/// The consequences of tubes at the frequencies that they cover, for starts within `deviations` of the curve,
/// one for each state. Where the amplitudes are in parts the bounds are valid for each of them. Fills
/// `slices`, in the order of their frequencies, unless it is null. Holds upward rounding.
[[nodiscard]] ProvedSet conclude(const TrackerModel& tracker, TubeSet tubes,
                                 const std::vector<rigor::Interval>& deviations,
                                 std::vector<FrequencySlice>* slices = nullptr);

/// The same tubes with R_`level` for R_0: smaller tubes, and the same proof. `level`: below the number of
/// levels of each tube.
[[nodiscard]] TubeSet from_level(TubeSet set, std::size_t level);

/// The set from its first level on at which the frequency error is certainly less than `required`,
/// rad/sample, if the assumed starts are inside; otherwise the set itself. Holds upward rounding.
[[nodiscard]] ProvedSet lowered_to(const TrackerModel& tracker, ProvedSet set,
                                   const std::vector<rigor::Interval>& deviations,
                                   const rigor::Interval& required);

}  // namespace veritrack::model
