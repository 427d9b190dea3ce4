// The largest eigenvalue of a matrix of balls, by its characteristic polynomial and the test of Schur and
// Cohn (docs/gain-proof.md, section 7).
#pragma once

#include "checker/model/gain/characteristic_polynomial.hpp"

namespace veritrack::checker {

/// All eigenvalues of every matrix in the balls are smaller than `radius` in size.
bool all_eigenvalues_within(const BallRows& matrix, const Ball& radius);
/// One eigenvalue of every matrix in the balls is larger than `radius` in size.
bool an_eigenvalue_beyond(const BallRows& matrix, const Ball& radius);

}  // namespace veritrack::checker
