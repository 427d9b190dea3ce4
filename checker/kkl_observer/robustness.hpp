// The effect of the assumed disturbance on the estimates of a KKL observer: the derivation "kkl-robustness".
#pragma once

#include "checker/kkl_observer/kkl_design.hpp"

namespace veritrack::checker {

/// Checks every bound of the derivation on cells of all signals of the range: from the settling time on,
/// for filters that start at rest, and `ell` in use in (9). The mathematics is that of docs/kkl-observer.md,
/// section Robustness.
void check_kkl_robustness(const Tree& derivation, const KklDesign& design, const Ball& ell,
                          Objections& objections);

}  // namespace veritrack::checker
