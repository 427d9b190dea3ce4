// The derivation of the probability of losing lock.
#pragma once

#include <vector>

#include "checker/quadrature/lock_probability.hpp"
#include "checker/sets/guarantee.hpp"
#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// The statements of the sets on the assumed starts, when any sets were proved. Objects to every statement of
/// the derivation that is not among these.
Promises check_lock(const Tree& derivation, const Design& design, const GaussianNoise& noise,
                    const std::vector<LockSet>& sets, Objections& objections);

}  // namespace veritrack::checker
