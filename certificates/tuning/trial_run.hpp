// The tracker of a design on simulated signals: its speed, and the size of its errors. Proves nothing.
#pragma once

#include <optional>

#include "certificates/design/design.hpp"
#include "certificates/sets/assumptions.hpp"

namespace veritrack::certificates {

/// Samples after which the estimate has followed a small step of the frequency, from the middle of the band
/// on and without noise, to within a tenth of it; empty when it does not within 20,000. Holds
/// round-to-nearest.
[[nodiscard]] std::optional<int> response_samples(const Design& design, const Assumptions& assume);

/// The frequency error, rad/sample.
struct SimulatedRms {
  double rms = 0.0;
  double deviation = 0.0;  ///< the standard error of `rms`, from the scatter over the runs
};

/// The extent of the simulation.
struct TrialLength {
  int runs = 16;
  int samples = 4000;  ///< of each run, of which the first quarter does not count
};

/// Over runs with seeds 1, 2, ..., which start with the largest errors that are assumed: noise as assumed (a
/// bound: uniform in the disc), the frequency walking as assumed, or going up and down the band as fast as
/// the slew allows. Empty when an estimate is not a number. Holds round-to-nearest; the result does not
/// depend on the number of threads.
[[nodiscard]] std::optional<SimulatedRms> simulated_rms(const Design& design, const Assumptions& assume,
                                                        const TrialLength& length = {});

}  // namespace veritrack::certificates
