// The quadrature tracker, without leak, from random starts far off a tone without noise: from which it locks.
#pragma once

#include <vector>

#include "trackers/tone_model.hpp"

namespace veritrack::experiments {

inline constexpr double kStartTone = 1.0;     ///< frequency of the tone, rad/sample, its amplitude 1
inline constexpr double kStartReach = 3.0;    ///< a start's frequency is off by up to this, rad/sample
inline constexpr int kStartSamples = 400;     ///< then it is locked within kStartLocked, or is not
inline constexpr double kStartLocked = 0.05;  ///< rad/sample

/// For the starts 1, 2, ..., the same for every design: 1 where it does not lock, 0 where it does. Phase and
/// frequency error are uniform, amplitude 1, P(0|0) = q2 I. An alias, a turn a sample off, does not count as
/// lock.
[[nodiscard]] std::vector<double> starts_without_lock(const trackers::ToneModel<double>& design, int starts);

}  // namespace veritrack::experiments
