// The answer to a question by gains, without tubes: for loops of two channels that do not depend on the phase
// of their signal (docs/gain-proof.md).
#pragma once

#include <optional>

#include "analysis/model/question/proved_sets.hpp"

namespace veritrack::model {

/// Empty where the rules of gains do not cover the loop, or its steady state was not found. Then tubes may.
/// The signal must be the tone alone. Needs the upward rounding mode.
[[nodiscard]] std::optional<ProvedSets> prove_by_gains(const SetQuestion& question);

}  // namespace veritrack::model
