// Bounds on the distance of the program's filters from those of the differential equations: docs/rounding.md,
// The KKL observer.
#pragma once

#include "analysis/kkl_observer/kkl_robustness.hpp"

namespace veritrack::kkl_observer {

/// A certificate without a sampling interval allows filters to deviate by this times the signal's amplitude
/// over their rates; its sentence says 1e-9.
inline constexpr double kAllowedDeviation = 0x1p-29;

/// With this share of it, a number that is proved for a neighbourhood of all filter states excludes xi = 0:
/// span(lambda, 1) comes near it, and has M xi = 0.
inline constexpr double kNeighbourhood = 0x1p-31;

/// Bounds on |computed xi_i - exact xi_i| over the signal's amplitude, filter by filter (s), with room for
/// the neighbourhood and, with a sampling interval, for an independent bound that is cruder. Without one:
/// kAllowedDeviation. With one: of trackers::KklObserver, stepped along straight lines between samples, from
/// filters that the signal and a disturbance, straight between samples, drive. Infinite when nothing is
/// known, and for a sinusoidal disturbance: of any frequency, it has any samples. For four to eight filters.
/// Needs the upward mode.
template <int M>
[[nodiscard]] KklFilters<M> filter_deviation(const KklRobustnessQuestionOf<M>& question);

}  // namespace veritrack::kkl_observer
