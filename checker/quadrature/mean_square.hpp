// The mean square of the frequency error in lock, in Gaussian noise: docs/gaussian.md, section 14.
#pragma once

#include <cstdint>
#include <vector>

#include "checker/document/json_tree.hpp"
#include "checker/quadrature/lock_left.hpp"
#include "checker/quadrature/lock_probability.hpp"
#include "checker/sets/guarantee.hpp"
#include "checker/theorems/design.hpp"

namespace veritrack::checker {

/// Reads the function and proves, for a set without objections from check_lock_set, that E U+ <= U + h (c -
/// nu^2) wherever the level is at most L. Objects where that fails. Throws OutOfBudget.
LockMeanSquare check_lock_mean_square(const Tree& tree, const Design& design, const LockSet& set,
                                      std::int64_t& cells, Objections& objections);

/// Adds to the promises, which must be those of "lock", the statements of these functions on the assumed
/// starts, one function for each of the sets, when they were proved. Objects to every statement of the
/// derivation that is not among these.
void check_mean_square(const Tree& derivation, const GaussianNoise& noise, const std::vector<LockSet>& sets,
                       const std::vector<LockMeanSquare>& mean_squares, Promises& promises,
                       Objections& objections);

/// An upper bound on the root of sum E[nu^2; lock]/N over any N successive samples, rad/sample, for starts of
/// a level of at most `start`.
Ball root_mean_square(const LockSet& set, const LockMeanSquare& mean_square, const Ball& start,
                      const Ball& samples);

}  // namespace veritrack::checker
