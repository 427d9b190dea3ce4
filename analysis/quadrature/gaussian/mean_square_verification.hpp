// Verification of a proposed bound on the mean square in lock, from nothing but the design and the proposal.
#pragma once

#include <string>

#include "analysis/quadrature/gaussian/lock_verification.hpp"
#include "analysis/quadrature/gaussian/mean_square_inequality.hpp"

namespace veritrack::quadrature {

/// Is the promise of LockMeanSquare true for this proposal, for every design in the intervals? The set must
/// have passed verify_lock_set. Checks the ranges of the numbers, then covers the set with cells, in
/// parallel; the result does not depend on the number of threads. At most `most_cells` in each of the parts
/// that are looked at by themselves. Opens its own UpwardRounding scopes; never throws for odd numbers.
[[nodiscard]] LockVerification verify_mean_square(const trackers::ToneModel<rigor::Interval>& design,
                                                  const LockSet& set, const LockMeanSquare& proposal,
                                                  std::int64_t most_cells = kMostLockCells);

/// Does verify_mean_square need at most about this many cells, judging by one in `every` of the parts of the
/// set? No when the proposal is out of range. Opens its own UpwardRounding scopes.
[[nodiscard]] bool expects_cells(const trackers::ToneModel<rigor::Interval>& design, const LockSet& set,
                                 const LockMeanSquare& proposal, std::size_t every, std::int64_t most_cells);

/// An upper bound on E[U; lock] where w is one on E[W; lock], with x = 2 log w and w no less than e, as log W
/// is the level and concave: beta w + (|R T^-1| sqrt(x) + |R f|)^2 + g x/gamma.
[[nodiscard]] rigor::Interval expected_form(const LockSet& set, const LockMeanSquare& mean_square,
                                            const rigor::Interval& expected_weight);

}  // namespace veritrack::quadrature
