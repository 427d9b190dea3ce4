// The closed loop of a regulator in double precision: for figures and tests. It proves nothing.
#pragma once

#include <vector>

#include "certificates/document/certificate.hpp"

namespace veritrack::certificates {

/// The loop on one signal: the lengths of output (without the noise in its measurement), input and
/// disturbance.
struct ClosedLoopRun {
  double frequency = 0.0;  ///< of the disturbance at sample 0, rad/sample
  std::vector<double> output, input, disturbance;
};

/// Runs on three disturbances that the design assumes, with noise up to the assumed bound, the tracker in
/// lock at the start: constant frequencies, the lowest, the middle and the highest of the band; with a slew,
/// three sweeps and walks through it. Empty where the tracker promises nothing. Holds its own rounding mode.
[[nodiscard]] std::vector<ClosedLoopRun> simulate_closed_loop(const Certificate& certificate);

}  // namespace veritrack::certificates
