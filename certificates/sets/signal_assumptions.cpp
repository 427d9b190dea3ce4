#include "certificates/sets/signal_assumptions.hpp"

#include "certificates/sets/gaussian_noise.hpp"

namespace veritrack::certificates {

SignalAssumptions signal_assumptions(const Assumptions& assume) {
  SignalAssumptions signal;
  const double amplitude = assume.amplitude.nearest;
  signal.amplitude = {amplitude, amplitude};
  signal.frequency = {assume.frequency[0].nearest, assume.frequency[1].nearest};
  if (assume.gaussian) {
    signal.noise_deviation = nearest_deviation(assume) * amplitude;
  } else {
    signal.noise = assume.noise.nearest;
  }
  if (assume.sample_rate) {
    signal.sample_rate = assume.sample_rate->nearest;
  }
  if (!frequency_walks(assume)) {
    signal.slew = assume.slew.nearest;
  }
  return signal;
}

}  // namespace veritrack::certificates
