// The comparison of section V of L. Praly, L. Marconi and A. Isidori, "A new observer for an unknown harmonic
// oscillator": theirs (trackers/kkl_observer/kkl_observer.hpp) and M. Hou's adaptive observer
// (adaptive_oscillator_observer.hpp) on 2 sin(3 t) + 0.2 sin(w t), w = 10, 100 and 1000 rad/s.
//
// Hou's parameters, its start, and the window of means and deviations are unpublished.
#pragma once

#include <array>
#include <vector>

#include "trackers/kkl_observer/adaptive_oscillator_observer.hpp"

namespace veritrack::experiments {

inline constexpr double kTrueFrequency = 3.0;                               // rad/s
inline constexpr std::array<double, 3> kDisturbances{10.0, 100.0, 1000.0};  // rad/s

/// Statistics of the frequency estimate in a window, rad/s. A NaN estimate counts as 0.
struct WindowStatistics {
  double mean = 0.0;
  double deviation = 0.0;
  double error = 0.0;  ///< root mean square about 3 rad/s
};

/// Hou's observer from the frequency `start` (rad/s) on, in the 20 s after `from` seconds.
struct HouSetting {
  trackers::AdaptiveObserverDesign design;
  double start = 2.0;
  double from = 20.0;
};
/// One choice that comes close to all six numbers of Figures 7 to 9: of a search (Sbplx, from 360 drawn
/// points).
[[nodiscard]] HouSetting hou_caption_setting();
[[nodiscard]] WindowStatistics hou_statistics(const HouSetting& setting, double disturbance);

/// Frequency estimates along a run, every 0.05 s.
struct ObserverTrace {
  std::vector<double> time, frequency;  ///< s, rad/s
};
[[nodiscard]] ObserverTrace hou_trace(const HouSetting& setting, double disturbance);

/// How an observer does: when its frequency is within 2 % for good, undisturbed, and the root mean square
/// error under each of kDisturbances, long after that.
struct ObserverPerformance {
  double settling = 0.0;  ///< s; 40 when it never is
  std::array<double, 3> error{};
};
/// The KKL observer with the rates `scale` times (1, 2, 3, 4) per s; the paper has 1.
[[nodiscard]] ObserverPerformance kkl_performance(double scale);
/// Hou's, started at 2 rad/s.
[[nodiscard]] ObserverPerformance hou_performance(const trackers::AdaptiveObserverDesign& design);

/// When the frequency is within 2 % for good, s, of another undisturbed sinusoid; 40 when it never is.
struct Sinusoid {
  double amplitude = 2.0;             ///< signal units
  double frequency = kTrueFrequency;  ///< rad/s
};
[[nodiscard]] double kkl_settling(double scale, const Sinusoid& sinusoid);
[[nodiscard]] double hou_settling(const trackers::AdaptiveObserverDesign& design, const Sinusoid& sinusoid);

/// Hou's observer with the smallest errors at 10 and 100 rad/s among those that settle within `settling` s,
/// as far as local searches from this many starts find it: a proposal.
[[nodiscard]] trackers::AdaptiveObserverDesign best_hou(double settling, int starts);

}  // namespace veritrack::experiments
