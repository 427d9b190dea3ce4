// Rates for the KKL observer (trackers/kkl_observer/kkl_observer.hpp), by search.
#pragma once

#include "analysis/kkl_observer/kkl_robustness.hpp"

namespace veritrack::kkl_observer {

/// Within what the rates are looked for.
struct KklTuningLimits {
  double slowest_rate = 0.1;   ///< 1/s
  double fastest_rate = 50.0;  ///< 1/s
  double settling_time = 0.0;  ///< s: at most, as propose_settling_time has it; 0: that of the rates given
  int evaluations = 250;       ///< of the search
};

/// Rates for which a small largest frequency error is seen in simulation (sample_errors) under the question's
/// disturbance, among those that settle in time: NLopt, from the rates given, in the logarithms of the
/// slowest rate and of the ratios of neighbours. The better of what was given and what was found. A proposal:
/// what it is worth bound_kkl_errors proves. Rounded to four digits, so that they can be written down.
[[nodiscard]] Eigen::Vector4d propose_rates(const KklRobustnessQuestion& question,
                                            const KklTuningLimits& limits);

}  // namespace veritrack::kkl_observer
