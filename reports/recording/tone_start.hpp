// The tone that a recording begins with: where a tracker starts.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "certificates/document/tracker_run.hpp"
#include "reports/recording/samples/sample_source.hpp"
#include "reports/recording/waveform.hpp"

namespace veritrack::reports {

/// How many samples to look at, for a band that begins at `lowest` rad/sample: four periods, but 256 to
/// 65536, and 2048 for a band that has no lowest frequency above 0.
[[nodiscard]] std::size_t start_length(double lowest);

/// Amplitude, phase and frequency at the first of these samples, none of which is missing. The frequency is
/// where ToneSearch::in_first finds the waveform, rad/sample, unless it is given; amplitude and phase are
/// those of least squares over two periods (but 32 samples), a constant aside.
[[nodiscard]] certificates::ToneAtSample find_tone(std::span<const RecordedSample> samples,
                                                   const Waveform& waveform, int channels,
                                                   const std::array<double, 2>& band,
                                                   std::optional<double> frequency);

}  // namespace veritrack::reports
