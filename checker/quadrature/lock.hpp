// The derivation of the probability of losing lock.
#pragma once

#include <optional>

#include "checker/quadrature/lock_probability.hpp"
#include "checker/sets/guarantee.hpp"
#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// What the set, when one was proved, says of the assumed starts. Objects to what the derivation says and
/// this does not.
Promises check_lock(const Tree& derivation, const Design& design, const GaussianNoise& noise,
                    const std::optional<LockSet>& set, Objections& objections);

}  // namespace veritrack::checker
