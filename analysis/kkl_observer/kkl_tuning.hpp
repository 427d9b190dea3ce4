// Rates for the KKL observer (trackers/kkl_observer/kkl_observer.hpp), by search.
#pragma once

#include "analysis/kkl_observer/kkl_robustness.hpp"

namespace veritrack::kkl_observer {

/// The limits of the search for rates.
struct KklTuningLimits {
  double slowest_rate = 0.1;   ///< 1/s
  double fastest_rate = 50.0;  ///< 1/s
  double settling_time = 0.0;  ///< s: at most, by propose_settling_time; 0: that of the given rates
  int evaluations = 250;       ///< of the search
};

/// Rates with a small largest frequency error in simulation (sample_errors) under the question's disturbance,
/// among those that settle in time: NLopt, from the given rates, in the logarithms of the slowest rate and of
/// the ratios of neighbours. Returns the better of the given and the found rates. A proposal:
/// bound_kkl_errors proves its worth. Rounded to four digits, so that they can be written down.
[[nodiscard]] Eigen::Vector4d propose_rates(const KklRobustnessQuestion& question,
                                            const KklTuningLimits& limits);

}  // namespace veritrack::kkl_observer
