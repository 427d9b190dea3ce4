// The simulations of section V of the KKL observer's paper (trackers/kkl_observer/kkl_observer.hpp), run
// again: a signal of amplitude 2 and frequency 3 rad/s under a sinusoid of amplitude 0.2 at 10, 100 and 1000
// rad/s. They prove nothing.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "analysis/statements/derivation.hpp"

namespace veritrack::kkl_observer {

/// Mean and standard deviation of an estimate in steady state.
struct SteadyStatistics {
  double mean = 0.0;
  double deviation = 0.0;
};

/// The estimates along a run.
struct EstimateSample {
  double time;       ///< s
  double amplitude;  ///< signal units; NaN where there is none
  double frequency;  ///< rad/s; NaN where there is none
};

/// One run: statistics over the last 2 pi seconds, a period of the disturbed signal, after 8 pi seconds.
struct SectionVRun {
  double disturbance_frequency = 0.0;   ///< rad/s
  SteadyStatistics amplitude;           ///< signal units
  SteadyStatistics frequency;           ///< rad/s
  std::vector<EstimateSample> samples;  ///< a few hundred, evenly spaced
};

/// The disturbances of the paper, rad/s.
inline constexpr std::array<double, 3> kSectionVDisturbances{10.0, 100.0, 1000.0};

/// The KKL observer with these rates (1/s) and this ell, its input interpolated between 40 samples or more a
/// period of the disturbance. Holds round-to-nearest.
[[nodiscard]] SectionVRun run_kkl_section_v(const Eigen::Vector4d& lambda, double ell,
                                            double disturbance_frequency);

/// The same in steady state (the filters' response to the two sinusoids, in closed form) over one window of
/// 20 s, with a phase of the disturbance; without samples. The captions of Figures 1 to 6 do not state the
/// window of their means and deviations. This choice reproduces all twelve: t from 5.687 to 25.674 s, y = 2
/// sin 3t + 0.2 sin(w t + 6.109). Holds round-to-nearest.
[[nodiscard]] SectionVRun run_caption_window(const Eigen::Vector4d& lambda, double ell,
                                             double disturbance_frequency);

/// The adaptive observer (trackers/kkl_observer/adaptive_oscillator_observer.hpp) on the same signal, with
/// our own parameters: the paper's are in a work that was not available. Statistics over the last 20 pi of 60
/// pi seconds.
[[nodiscard]] SectionVRun run_adaptive_section_v(double disturbance_frequency);

/// The derivation "kkl-section-v": means and deviations for this ell beside those printed in the captions of
/// Figures 1 to 6, over a period of the disturbed signal and over the window of run_caption_window; how many
/// of the twelve agree to the last digit, and within a unit of it; and the adaptive observer's beside Figures
/// 7 to 9. Nothing in it is proved, and it has no verdict.
[[nodiscard]] theorems::Derivation derive_kkl_section_v(const Eigen::Vector4d& lambda, double ell);

}  // namespace veritrack::kkl_observer
