#include "certificates/sets/signal_assumptions.hpp"

#include "certificates/sets/gaussian_noise.hpp"

namespace veritrack::certificates {

SignalAssumptions signal_assumptions(const Assumptions& assume) {
  SignalAssumptions signal;
  signal.amplitude = assume.amplitude.nearest;
  signal.frequency = {assume.frequency[0].nearest, assume.frequency[1].nearest};
  if (assume.gaussian) {
    signal.noise_deviation = nearest_deviation(assume) * signal.amplitude;
  } else {
    signal.noise = assume.noise.nearest;
  }
  if (!frequency_walks(assume)) {
    signal.slew = assume.slew.nearest;
  }
  return signal;
}

}  // namespace veritrack::certificates
