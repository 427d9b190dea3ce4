// The derivation of the probability of losing lock.
#pragma once

#include <vector>

#include "checker/quadrature/lock_probability.hpp"
#include "checker/sets/guarantee.hpp"
#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// What the sets, when any were proved, say of the assumed starts. Objects to what the derivation says and
/// this does not.
Promises check_lock(const Tree& derivation, const Design& design, const GaussianNoise& noise,
                    const std::vector<LockSet>& sets, Objections& objections);

}  // namespace veritrack::checker
