// The steady state of the quadrature tracker: where it settles without noise on a tone of constant frequency,
// and so its bias.
//
// Without a leak (epsilon = 0) it settles without bias at every frequency. With a leak the prediction pulls
// the frequency towards zero, and the steady state is a fixed point X*(omega) of the polar-frame map away
// from the truth. That map has several fixed points; this one is on the lock branch, which starts at omega =
// 0 from the exact estimate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/rigor/verdict.hpp"
#include "analysis/sets/fixed_point_branch.hpp"
#include "analysis/sets/fixed_point_quadrature.hpp"
#include "analysis/statements/derivation.hpp"

namespace veritrack::sets {

/// Fixed points of the quadrature tracker over a range of frequencies.
using BranchCell = FixedPointFamily<QuadraturePolarLoop::kStates>;

/// The bias of the steady state, over a range of frequencies.
struct SteadyStateError {
  rigor::Interval frequency;        ///< the true frequencies covered, rad/sample
  rigor::Interval frequency_error;  ///< nu*, rad/sample
  rigor::Interval phase_error;      ///< psi*, rad
  rigor::Interval amplitude_error;  ///< a*, relative to the amplitude
};

/// The lock branch over a band of frequencies.
struct LockBranch {
  /// PROVED: one branch of fixed points, continued from omega = 0, is verified over the whole band, with P*
  /// positive definite. UNDECIDED otherwise; the reason says where it stops.
  rigor::Verdict verdict = rigor::Verdict::undecided;
  std::string reason;
  /// rad/sample; the verified branch ends there, inside the band. Set only where that is why it is undecided.
  std::optional<double> ends_at;
  rigor::Interval band;  ///< as asked for, rad/sample
  /// Frequencies over which the branch is verified, within [0, band] or [band, 0] or both; empty when there
  /// is none.
  rigor::Interval verified;
  std::vector<BranchCell> cells;  ///< the part of it that covers the band
};

/// Verifies the lock branch over `band` (rad/sample), for every design in `design` and amplitude 1. Holds its
/// own rounding mode.
[[nodiscard]] LockBranch verify_lock_branch(const trackers::ToneModel<rigor::Interval>& design,
                                            const rigor::Interval& band, const BranchSteps& steps = {});

/// The steady state of one cell. Needs the upward mode.
[[nodiscard]] SteadyStateError steady_state_error(const BranchCell& cell);

/// The quantity "bias_frequency": an enclosure of nu*(omega) for all omega of the band; not applicable, with
/// the branch's reason, unless the branch is PROVED. Holds its own rounding mode.
[[nodiscard]] theorems::Quantity frequency_bias(const LockBranch& branch);

}  // namespace veritrack::sets
