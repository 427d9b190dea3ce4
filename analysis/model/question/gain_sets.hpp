// The answer to a question by gains, without tubes: for loops that do not depend on the phase of their
// signal, or, with one channel, do so on the average (docs/gain-proof.md).
#pragma once

#include <optional>

#include "analysis/model/question/no_gains.hpp"
#include "analysis/model/question/proved_sets.hpp"

namespace veritrack::model {

/// Empty where the rules of gains do not cover the loop, or its steady state was not found. Then tubes may.
/// The signal must be the tone alone. `reason` then receives why. Needs the upward rounding mode.
[[nodiscard]] std::optional<ProvedSets> prove_by_gains(const SetQuestion& question,
                                                       NoGains* reason = nullptr);

/// Whether its bound in the long run is near to that of the linear recursion, or the steady state is
/// unstable: then no tube is better. Needs the upward rounding mode.
[[nodiscard]] bool is_near_linear(const ProvedSets& by_gains);

}  // namespace veritrack::model
