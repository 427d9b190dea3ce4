// Verification of a set around the steady state: the proof, from nothing but the design, the verified lock
// branch and the proposal. docs/leak.md.
#pragma once

#include <cstdint>
#include <string>

#include "analysis/quadrature/leak/steady_gain.hpp"
#include "analysis/quadrature/leak/steady_set.hpp"
#include "analysis/quadrature/rounding/step_rounding.hpp"
#include "analysis/sets/fixed_point_bias.hpp"

namespace veritrack::quadrature {

/// The result of verify_steady_set.
struct SteadyVerification {
  /// PROVED: the promise of SteadySet over all cells of the branch. Otherwise UNDECIDED: that a set was not
  /// certified refutes nothing.
  rigor::Verdict verdict = rigor::Verdict::undecided;
  std::string reason;                ///< one sentence
  SteadySet set;                     ///< the proposal, without the last levels if those fail
  rigor::Interval failed_frequency;  ///< the cell where it failed, rad/sample; empty when it did not
  std::int64_t cells = 0;            ///< examined
};

/// Is the claim of SteadySet true over these neighbouring cells of a lock branch? The proof shows
///   1. T invertible, below > 0, above > 0, P* - below > 0, and the ranges of all inputs;
///   2. the errors of each level map into the next one (steady_contraction.hpp), and
///   3. so does the covariance (steady_order.hpp), for every cell of frequencies. From the last but one level
///      a step maps into the last, and so it does from the last, which is a part of it.
/// The first level that does not map into the next one and all later ones are dropped, as long as one step
/// remains. Both include the rounding of the program in double precision (steady_rounding.hpp). Cells run in
/// parallel; the result does not depend on the number of threads. Opens its own UpwardRounding scope; never
/// throws for invalid numbers.
[[nodiscard]] SteadyVerification verify_steady_set(const trackers::ToneModel<rigor::Interval>& design,
                                                   const std::vector<sets::BranchCell>& branch,
                                                   const SteadySet& proposal,
                                                   const TrackedSignal& signal = {});

/// The steady state over a part of a cell. Needs the upward mode.
[[nodiscard]] SteadyState<rigor::Interval> steady_state(const sets::BranchCell& cell,
                                                        const rigor::Interval& part);

}  // namespace veritrack::quadrature
