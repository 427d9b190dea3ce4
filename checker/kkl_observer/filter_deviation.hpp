// Bounds on the distance of the program's filters from those of the differential equations (docs/rounding.md,
// The KKL observer).
#pragma once

#include "checker/kkl_observer/moves.hpp"

namespace veritrack::checker {

/// The statements proved for a neighbourhood of all filter states, of this size times the amplitude over the
/// rates, keep them away from zero: span(lambda, 1), where M xi = 0, comes near zero.
inline const Ball neighbourhood(0x1p-31);

/// Over the signal's amplitude, filter by filter (s), with the neighbourhood. Without a sampling interval:
/// more than the 1e-9 over the rates of the sentence. With one: of the program that takes its input to be
/// straight between samples; balls of everything for a sinusoidal disturbance, which, of any frequency, may
/// have any samples.
Filters filter_deviation(const KklDesign& design);

}  // namespace veritrack::checker
