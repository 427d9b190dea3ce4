// The answer to a question by gains that are resolved over the phases, without tubes
// (docs/gain-proof.md, section 10).
#pragma once

#include <optional>

#include "analysis/model/question/no_gains.hpp"
#include "analysis/model/question/proved_sets.hpp"

namespace veritrack::model {

/// The limits that other proofs have.
struct KnownLimits {
  double noise = 0.0;  ///< that is tolerated, signal units
  double reach = 0.0;  ///< the largest frequency error at the start, rad/sample
};

/// Empty where no basis with constant coefficients was found, where the rules do not cover the loop, or where
/// no bounds close, even without noise. `reason` then receives why. Less than what is known is not searched
/// for. Parts of the frequencies are worked on in parallel. Needs the upward rounding mode.
[[nodiscard]] std::optional<PhaseProof> prove_by_phase_gains(const SetQuestion& question, KnownLimits known,
                                                             NoGains* reason = nullptr);

}  // namespace veritrack::model
