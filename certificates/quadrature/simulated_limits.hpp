// The start error and the noise that the tracker tolerates in simulation, for comparison with certified
// bounds. A simulation proves nothing.
#pragma once

#include "certificates/design/design.hpp"

namespace veritrack::certificates {

/// In double precision, at the middle of the assumed frequencies, from the steady-state covariance.
struct SimulatedLimits {
  double frequency_error = 0.0;  ///< rad/sample: with exact phase and amplitude it locks up to this error
  double noise = 0.0;  ///< relative to the amplitude: up to this noise the estimate stays on the signal's
                       ///< side
  double rate = 0.0;   ///< factor of the error per sample, near the lock
};

/// Searches for the limits: the start error upwards from zero on both sides, until 300 noise-free samples do
/// not bring the tracker back to within 0.001 of the run without an error; the noise likewise, in nine
/// patterns (constant, turning at several rates, at random) of 300 samples, until the estimate lies more than
/// a quarter turn from the signal. Deterministic. Holds round-to-nearest.
[[nodiscard]] SimulatedLimits find_simulated_limits(const Design& design);

}  // namespace veritrack::certificates
