// Margins of a loop that a phase detector closes, in floating point: for what engineers ask of it. Not
// evidence.
#pragma once

#include <optional>

#include "analysis/linear/detector_loop.hpp"

namespace veritrack::linear {

/// Factors of the detector's gain: stable from `low` to `high`; 0 and infinity where there is no limit within
/// 1e3.
struct GainMargin {
  double low = 0.0;
  double high = 0.0;
};
/// The factors f for which A - (f - 1) b c is stable (docs/gain-proof.md, section 7), of a loop that is
/// stable with f = 1.
[[nodiscard]] GainMargin gain_margin(const DetectorLoop& loop);

/// The delay that a stable loop still tolerates. The open loop is c (z - A - b c)^-1 b.
struct DelayMargin {
  double samples = 0.0;    ///< a further delay in the loop, shorter than this
  double phase = 0.0;      ///< rad, at the crossover where a delay does harm first
  double crossover = 0.0;  ///< rad/sample: there the gain of the open loop is 1
};
/// Empty where the gain of the open loop is 1 at no frequency from 1e-7 rad/sample on.
[[nodiscard]] std::optional<DelayMargin> delay_margin(const DetectorLoop& loop);

}  // namespace veritrack::linear
