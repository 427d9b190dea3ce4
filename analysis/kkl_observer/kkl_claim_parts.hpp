// The parts of the derivation "kkl-paper" and their construction.
#pragma once

#include <string>

#include "analysis/kkl_observer/kkl_claims.hpp"

namespace veritrack::kkl_observer::detail {

[[nodiscard]] theorems::Condition condition(std::string id, std::string statement, rigor::Verdict verdict,
                                            std::string reason,
                                            const rigor::Interval& lhs = rigor::Interval(),
                                            const rigor::Interval& rhs = rigor::Interval());

/// The quantity, not applicable where its value is empty.
[[nodiscard]] theorems::Quantity bounded(theorems::Quantity quantity);

/// Adds the statements on gamma, for four to eight filters. Needs the upward mode.
void add_inverse(const KklClaimsQuestion& question, theorems::Derivation& derivation);

}  // namespace veritrack::kkl_observer::detail
