// Verification of a proposed LockSet: the proof of the drift inequality, from nothing but the design and the
// proposal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "analysis/quadrature/gaussian/drift_inequality.hpp"
#include "analysis/rigor/verdict.hpp"

namespace veritrack::quadrature {

/// In each of the parts of a set that are looked at by themselves.
inline constexpr std::int64_t kMostLockCells = 60'000;

/// The result of verify_lock_set.
struct LockVerification {
  rigor::Verdict verdict = rigor::Verdict::undecided;  ///< proved or undecided
  std::string reason;                                  ///< one sentence
  std::int64_t cells = 0;                              ///< examined; of a proof
};

/// Is the promise of LockSet true for this proposal, for every design in the intervals? Checks the form and
/// the ranges of its numbers, then covers the set with cells, in parallel; the result does not depend on the
/// number of threads. At most `most_cells` in each of the parts that are looked at by themselves. Opens its
/// own UpwardRounding scopes; never throws for odd numbers.
[[nodiscard]] LockVerification verify_lock_set(const trackers::ToneModel<rigor::Interval>& design,
                                               const LockSet& proposal,
                                               std::int64_t most_cells = kMostLockCells);

/// Does verify_lock_set need at most about this many cells, judging by one in `every` of the parts of the
/// set? No when the proposal is out of range. Opens its own UpwardRounding scopes.
[[nodiscard]] bool expects_cells(const trackers::ToneModel<rigor::Interval>& design, const LockSet& proposal,
                                 std::size_t every, std::int64_t most_cells);

}  // namespace veritrack::quadrature
