// The samples of a recording as a tracker takes them.
#pragma once

#include <memory>
#include <string>

#include "certificates/document/tracker_run.hpp"
#include "reports/recording/samples/sample_source.hpp"

namespace veritrack::reports {

/// A source with as many channels as the tracker has.
struct FittingSource {
  std::unique_ptr<SampleSource> samples;
  std::string note;  ///< a sentence about what was done to the recording; empty when nothing was
};

/// A recording with two channels gives one tracker its in-phase samples; one with a single channel gives a
/// quadrature tracker a quadrature part from a Hilbert filter, whose gain is within 0.001 of 1 over the band
/// that is assumed, as far as 4095 coefficients allow.
[[nodiscard]] FittingSource fit_channels(std::unique_ptr<SampleSource> recording, int channels,
                                         const certificates::SignalAssumptions& assume);

}  // namespace veritrack::reports
