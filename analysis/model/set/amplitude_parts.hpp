// A constant amplitude that is known to be in a range: the range is cut into parts, each with its own tubes,
// within which every sample may have another amplitude (docs/model-proof.md, section 17).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "analysis/model/set/tube_set.hpp"
#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// low < high, signal units.
struct AmplitudeRange {
  double low = 0.0;
  double high = 0.0;
};

/// A range in equal parts, from low amplitudes to high ones; neighbours have an end in common, and the first
/// and the last end are a little beyond those of the range. Throws std::invalid_argument for zero parts, for
/// more than doubles can distinguish, and for a range that is empty or not finite.
[[nodiscard]] std::vector<AmplitudeRange> equal_parts(const rigor::Interval& range, std::size_t count);

/// A tracker on a tone of an amplitude, from which those of samples may deviate by at most `deviation`;
/// signal units.
using ToneAtAmplitude = std::function<TrackedTone(double amplitude, double deviation)>;

/// The most parts into which a range is cut.
inline constexpr std::size_t kMostAmplitudeParts = 48;

/// The number of parts into which a range is to be cut, for the frequencies low to high, rad/sample: the
/// effect of the amplitudes of a part is about an eighth of the noise that tubes tolerate, where that is
/// least among the places that are tried. A guess, not evidence; at most `kMostAmplitudeParts`. Deterministic
/// up to the deadline.
[[nodiscard]] std::size_t parts_of_range(const ToneAtAmplitude& tone_at, const rigor::Interval& range,
                                         double low, double high, const search::Deadline& deadline);

/// The sets that were proved for these parts, in their order, as one: for their least noise and slew, and for
/// the frequencies that all cover. Nothing is proved where one of them is not proved. Throws
/// std::invalid_argument unless there is a part for each set, and at least one.
[[nodiscard]] TubeSet join_amplitudes(std::vector<TubeSet> sets, const std::vector<AmplitudeRange>& parts);

/// The set of each part, in order, for the noise and the slew of the whole; the set itself where it has no
/// parts, or is the one of a part.
[[nodiscard]] std::vector<TubeSet> sets_of_amplitudes(const TubeSet& set);

/// The tracker on the amplitudes of the set of a part, of which every sample may have another one; the
/// tracker as it is for a set without parts. Throws std::invalid_argument for a set of several parts.
[[nodiscard]] TrackerModel on_amplitudes_of(TrackerModel model, const TubeSet& set);

}  // namespace veritrack::model
