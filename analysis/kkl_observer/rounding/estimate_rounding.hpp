// Rounding in the bounds on the errors of the KKL observer's estimates: docs/rounding.md, The KKL observer.
#pragma once

#include "analysis/kkl_observer/kkl_robustness.hpp"

namespace veritrack::kkl_observer {

/// Adds the effect of rounding of the static map on estimates whose exact errors are within the bounds of
/// `result`, with room for an independent bound that is cruder. `transient`: the distance of the filters from
/// the response to signal and disturbance, over the amplitude. Where rounding has no bound the errors have
/// none. For four to eight filters. Needs the upward mode.
template <int M>
void add_rounding(const KklRobustnessQuestionOf<M>& question, const KklFilters<M>& transient,
                  KklRobustness& result);

}  // namespace veritrack::kkl_observer
