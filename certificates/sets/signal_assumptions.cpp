#include "certificates/sets/signal_assumptions.hpp"

#include <fmt/format.h>

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
  if (assume.samples) {
    signal.samples = assume.samples->nearest;
  }
  signal.start = {
      fmt::format("frequency off by at most {:.4g} rad/sample", assume.initial_frequency_error.nearest),
      fmt::format("phase off by at most {} rad", assume.initial_phase_error.text),
      fmt::format("amplitude off by at most {}", assume.initial_amplitude_error.text),
      assume.initial_covariance || assume.covariance_range || assume.covariance_multiples
          ? "covariance as the design file says"
          : "covariance of the steady state",
  };
  return signal;
}

}  // namespace veritrack::certificates
