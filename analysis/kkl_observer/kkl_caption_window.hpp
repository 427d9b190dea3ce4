// The captions of Figures 1 to 6 of the KKL observer's paper (trackers/kkl_observer/kkl_observer.hpp): means
// and deviations of the estimates in steady state. The paper states neither the time over which they are
// taken nor the phase of the disturbance. Simulation: it proves nothing.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "analysis/kkl_observer/kkl_section_v.hpp"

namespace veritrack::kkl_observer {

/// The signal of section V, A sin 3t, and its disturbance, a sin(w t + phase).
inline constexpr double kSectionVAmplitude = 2.0;    ///< A, signal units
inline constexpr double kSectionVFrequency = 3.0;    ///< rad/s
inline constexpr double kSectionVDisturbance = 0.2;  ///< a, signal units

/// Steps in 2 pi seconds, a multiple of the signal's own period, fine enough for a disturbance of this
/// frequency, rad/s.
[[nodiscard]] long section_v_steps(double disturbance_frequency);

/// The choices that the paper leaves open.
struct CaptionWindow {
  double begin = 5.687;  ///< s
  double end = 25.674;   ///< s
  double phase = 6.109;  ///< of the disturbance at t = 0, rad
};
/// The choice that gives all twelve numbers of the captions: a search found it.
inline constexpr CaptionWindow kCaptionWindow{};

/// Another choice, drawn: 15 to 25 s, from between 5 and 15 s on, in any phase.
[[nodiscard]] CaptionWindow drawn_caption_window(std::uint64_t seed);

/// The observer's estimates over a window.
struct CaptionStatistics {
  SteadyStatistics amplitude;            ///< signal units; NaN unless there is an estimate at every moment
  SteadyStatistics frequency;            ///< rad/s; the same
  SteadyStatistics amplitude_where_any;  ///< over the moments that have an estimate
  SteadyStatistics frequency_where_any;
  double without_estimate = 0.0;  ///< share of the moments at which the estimated x3 is not positive
  double largest_ell = 0.0;       ///< the largest ell for which mu of (9) vanishes at every moment
};

/// In steady state: the filters with these rates (1/s) at their response to both sinusoids, in closed form.
/// Holds round-to-nearest.
[[nodiscard]] CaptionStatistics caption_statistics(const Eigen::Vector4d& lambda, double ell,
                                                   double disturbance_frequency,
                                                   const CaptionWindow& window = kCaptionWindow);

}  // namespace veritrack::kkl_observer
