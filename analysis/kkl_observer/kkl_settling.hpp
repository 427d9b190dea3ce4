// The time for which the filters of the KKL observer remember that they started at rest.
#pragma once

#include "analysis/kkl_observer/kkl_robustness.hpp"

namespace veritrack::kkl_observer {

/// The remaining effect of the start after `time` (s), filter by filter and relative to the signal's
/// amplitude A: exp(-lambda t) (|T(x(0))| + |response to the disturbance at 0|) / A. It also bounds the
/// remaining effect at any later time. Needs the upward mode.
template <int M>
[[nodiscard]] KklFilters<M> transient_at(const KklRobustnessQuestionOf<M>& question,
                                         const rigor::Interval& time);

/// A time (s) after which the start adds little to the effect of the disturbance on the frequency (or,
/// without one, to a thousandth of the lowest frequency): a proposal by sampling, on which a bound is then
/// proved. Both for four to eight filters.
template <int M>
[[nodiscard]] double propose_settling_time(const KklRobustnessQuestionOf<M>& question);

}  // namespace veritrack::kkl_observer
