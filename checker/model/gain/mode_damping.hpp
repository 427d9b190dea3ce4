// The damping of the modes of a linear recursion, by the argument principle (docs/gain-proof.md, section 7).
#pragma once

#include <cstddef>
#include <optional>

#include "checker/model/gain/characteristic_polynomial.hpp"

namespace veritrack::checker {

/// The number of eigenvalues, the same for every matrix in the balls, whose damping ratio is larger than
/// `damping`, with those that are 0 among them. Nothing where that is not certain, and unless 0 < damping
/// < 1.
std::optional<std::size_t> modes_damped_more_than(const BallRows& matrix, const Ball& damping);

}  // namespace veritrack::checker
