// The experiments of P. Zarchan's slides "Tracking a Sine Wave" (trackers/zarchan/zarchan_ekf.hpp): sin(W t),
// measured every TS seconds for 20 s in white Gaussian noise, and the four filters with the slides' starts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace veritrack::experiments {

enum class ZarchanFilter : std::uint8_t {
  phase,             ///< (phi, omega, A)
  known_amplitude,   ///< (phi, omega)
  oscillator,        ///< (x, v, omega)
  squared_frequency  ///< (x, v, z = omega^2)
};

struct ZarchanExperiment {
  ZarchanFilter filter = ZarchanFilter::phase;
  double frequency = 1.0;        ///< W, rad/s
  double first_estimate = 2.0;   ///< WH, rad/s; filter 4 starts at its square
  double noise_deviation = 1.0;  ///< sigma, signal units; the filter knows it
  double process_noise = 0.0;    ///< spectral density of the frequency's noise, and of the amplitude's
  double interval = 0.1;         ///< TS, s
};

inline constexpr double kZarchanSeconds = 20.0;

/// A sample: the state as the slides number it, its truth, and the deviation that the filter computes.
struct ZarchanSample {
  std::array<double, 3> state{}, truth{}, deviation{};  ///< two of the second filter; the rest is 0
};

/// Index of the frequency (of its square in filter 4) among the states.
[[nodiscard]] constexpr std::size_t frequency_state(ZarchanFilter filter) {
  return filter == ZarchanFilter::phase || filter == ZarchanFilter::known_amplitude ? 1 : 2;
}

using ZarchanRun = std::vector<ZarchanSample>;  ///< at TS, 2 TS, ..., 20 s

/// Those of the seeds after `before`: before + 1, ..., before + runs.
[[nodiscard]] std::vector<ZarchanRun> zarchan_runs(const ZarchanExperiment& experiment, int runs,
                                                   int before = 0);

/// Whether a state is within `tolerance` of `sign` times its truth in all samples after `from` seconds.
[[nodiscard]] bool stays_within(const ZarchanRun& run, double interval, std::size_t state, double tolerance,
                                double from, double sign = 1.0);

/// Whether the last error of a state is at most the deviation that the filter computes.
[[nodiscard]] bool within_deviation(const ZarchanRun& run, std::size_t state);

}  // namespace veritrack::experiments
