// The list of who looks for what.
#pragma once

#include <memory>
#include <vector>

#include "reports/recording/findings/finding.hpp"

namespace veritrack::reports {

// Defects that spoil samples for the detectors that come later.
[[nodiscard]] std::unique_ptr<Detector> clipping_detector(int channels);
[[nodiscard]] std::unique_ptr<Detector> dropout_detector(int channels);
[[nodiscard]] std::unique_ptr<Detector> quantisation_detector(const certificates::SignalAssumptions& assume,
                                                              int channels);
// The detectors that examine the fit of each block.
[[nodiscard]] std::unique_ptr<Detector> offset_detector(int channels);
[[nodiscard]] std::unique_ptr<Detector> harmonics_detector();
[[nodiscard]] std::unique_ptr<Detector> hum_detector();
[[nodiscard]] std::unique_ptr<Detector> amplitude_detector(const certificates::SignalAssumptions& assume);
[[nodiscard]] std::unique_ptr<Detector> sweep_detector(const certificates::SignalAssumptions& assume,
                                                       int channels);

/// All of them, those first that spoil samples for others.
[[nodiscard]] std::vector<std::unique_ptr<Detector>> all_detectors(
    const certificates::SignalAssumptions& assume, int channels);

}  // namespace veritrack::reports
