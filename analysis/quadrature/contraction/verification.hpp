// Verification of a proposed set: the proof, from nothing but the design and the proposal.
#pragma once

#include <cstdint>
#include <string>

#include "analysis/quadrature/contraction/certified_set.hpp"
#include "analysis/quadrature/rounding/step_rounding.hpp"
#include "analysis/rigor/verdict.hpp"
#include "trackers/tone_model.hpp"

namespace veritrack::quadrature {

/// The result of verify_certified_set.
struct Verification {
  rigor::Verdict verdict =
      rigor::Verdict::undecided;  ///< proved or undecided: a failed search refutes nothing
  std::string reason;             ///< one sentence: the proved claim, or the step that failed
  CertifiedSet set;               ///< the proposal, with what rounding may add
  std::int64_t cells = 0;         ///< examined
};

/// Is the promise of CertifiedSet true for this proposal, for every design in the intervals? Proved are
///   1. P_lo > 0, P_hi - P_lo > 0, T invertible, 0 <= rate < 1, and the ranges of all inputs;
///   2. |T e+|^2 <= rate^2 |T e|^2 + L_v^2 |v|^2 + L_w^2 w^2 over the set, for |v| <= V and |w| <= W
///      (error_contraction.hpp);
///   3. invariance of the covariance bounds under every |z| and turn that occur in the set with noise up to V
///      (riccati_order.hpp);
///   4. sqrt(rate^2 R^2 + L_v^2 V^2 + L_w^2 W^2) + error_rounding <= R,
/// the last two with room for the rounding of the program, which is bounded here, not read from the proposal
/// (set_rounding.hpp). By 3 and 4 a step does not leave the set, so that 2 applies to the next;
/// docs/contraction.md and docs/rounding.md have the proof. epsilon must be zero. Opens its own
/// UpwardRounding scope; never throws for odd numbers.
[[nodiscard]] Verification verify_certified_set(const trackers::ToneModel<rigor::Interval>& design,
                                                const CertifiedSet& proposal,
                                                const TrackedSignal& signal = {});

}  // namespace veritrack::quadrature
