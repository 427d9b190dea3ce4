// The common parts of the searches for sets of tubes.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "analysis/model/set/tube_set.hpp"

namespace veritrack::model {

/// The proposal of tubes for a task, over a band in rad/sample.
[[nodiscard]] BandSettings settings_of(const TrackedTone& tone, const SetTask& task, double low, double high);

/// Approximately the largest radius up to 1.6 `level`, and down to 1e-4 of it, for which `may_hold(radius)`;
/// 0 when there is none. With noise growth is too large for small radii, and always for large ones.
template <typename Test>
[[nodiscard]] double largest_radius(double level, const Test& may_hold) {
  double radius = 0.0;
  for (double guess = 1.6 * level; guess > 1e-4 * level && radius == 0.0; guess *= 0.8) {
    radius = may_hold(guess) ? guess : 0.0;
  }
  for (double step = 1.12; step > 1.01 && radius > 0.0; step = std::sqrt(step)) {
    radius = may_hold(radius * step) ? radius * step : radius;
  }
  return radius;
}

/// The factor that is verified where `shrinking` is claimed: a little less, for a checker whose bounds are
/// cruder.
[[nodiscard]] double with_room(double shrinking);

/// ", where the denominator x (line 3) may vanish with frequency errors up to about 0.1 rad/sample, and not
/// with those up to about 0.02", when an operation may be undefined in the tube of the cell; or nothing. A
/// diagnosis.
[[nodiscard]] std::string words_of_undefined(const TrackedTone& tone, const TrackerModel& model,
                                             const TubeProposal& cell, double radius, double noise);

/// "between 0.1 and 0.2 rad/sample".
[[nodiscard]] std::string place_of_cell(const TubeProposal& cell);

/// Whether tubes in the order of their frequencies cover the band, ends included.
[[nodiscard]] bool covers(const std::vector<ProvedTube>& tubes, double low, double high);

/// Makes the band of a tube a little wider: neighbours overlap, whatever the rounding.
void widen(Tube& tube);

/// Whether frequency errors in the tube are known, and smaller than the frequency.
[[nodiscard]] bool is_locked(const TrackerModel& model, const Tube& tube, double radius);

}  // namespace veritrack::model
