// The worst effect of a disturbance on the KKL observer in simulation, for comparison with the proved bounds.
// It proves nothing.
#pragma once

#include "analysis/kkl_observer/kkl_robustness.hpp"

namespace veritrack::kkl_observer {

/// Observed errors.
struct SampledErrors {
  double frequency = 0.0;  ///< rad/s
  double amplitude = 0.0;  ///< signal units
};

/// The largest errors of the observer as it runs (trackers::kkl_inverse, in double, with the ell in use) over
/// a grid of signals (`phases` of them over half a turn), with filters that have forgotten their start: all
/// phases of a sinusoidal disturbance at the lowest frequency allowed, and for a bounded one the input that
/// is worst for the frequency to first order. For four to eight filters. Holds round-to-nearest.
template <int M>
[[nodiscard]] SampledErrors sample_errors(const KklRobustnessQuestionOf<M>& question, int phases = 90);

}  // namespace veritrack::kkl_observer
