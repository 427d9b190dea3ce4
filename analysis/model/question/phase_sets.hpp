// The answer to a question by gains that are resolved over the phases, without tubes
// (docs/gain-proof.md, section 10).
#pragma once

#include <optional>
#include <string>

#include "analysis/model/question/proved_sets.hpp"

namespace veritrack::model {

/// Empty where no basis with constant coefficients was found, where the rules do not cover the loop, or where
/// its bound in the long run is far from that of the linear recursion: then tubes may be better. `reason`
/// then receives why. `known_reach`: the largest frequency error at the start for which there is a set
/// already, rad/sample; less is not searched for. Parts of the frequencies are worked on in parallel. Needs
/// the upward rounding mode.
[[nodiscard]] std::optional<PhaseProof> prove_by_phase_gains(const SetQuestion& question, double known_reach,
                                                             std::string* reason = nullptr);

}  // namespace veritrack::model
