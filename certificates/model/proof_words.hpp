// Why a proof was not made, in the words of the design file.
#pragma once

#include <optional>
#include <string>

#include "analysis/model/question/proof_choice.hpp"

namespace veritrack::certificates {

/// Clauses without a full stop: for gains by constant coefficients, and over the phase.
[[nodiscard]] std::string gains_words(const model::NoGains& reason);
[[nodiscard]] std::string phase_gains_words(const model::NoGains& reason);

/// Why nothing is searched for; `no_gains` is the reason why gains do not answer, where there is one.
[[nodiscard]] std::string objection_words(const model::ProofObjection& objection,
                                          const std::optional<model::NoGains>& no_gains);

}  // namespace veritrack::certificates
