// The set of a certificate for another signal-to-noise ratio than the assumed one, and its consequences.
#pragma once

#include <optional>

#include "checker/quadrature/lock_probability.hpp"
#include "checker/sets/guarantee.hpp"
#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// Reads a set and proves the same as check_lock_set, but for noise of the set's own deviation in place of
/// the assumed one. Throws OutOfBudget.
LockSet check_lowest_snr_set(const Tree& tree, const Design& design, const GaussianNoise& noise,
                             std::int64_t& cells, Objections& objections);

/// Adds to the promises the statements of this set, when it was proved, on the assumed starts. Objects to
/// every statement of the derivation that is not among these.
void check_lowest_snr(const Tree& derivation, const Design& design, const GaussianNoise& noise,
                      const std::optional<LockSet>& set, Promises& promises, Objections& objections);

/// -10 log10(2 sigma^2): the signal-to-noise ratio of a deviation in each channel, dB, at amplitude 1.
Ball decibels_of(const Ball& deviation);

}  // namespace veritrack::checker
