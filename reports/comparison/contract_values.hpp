// Two values of a key of a design: which of them makes the stronger contract?
#pragma once

#include <string>

#include "certificates/design/key_contract.hpp"
#include "reports/comparison/measured_number.hpp"

namespace veritrack::reports {

/// What the second of two values is beside the first. What cannot be told for certain is `incomparable`.
enum class Relation { equal, stronger, weaker, incomparable };

/// Numbers in Hz are compared with numbers in rad/sample by the sample rates; with two different sample rates
/// everything is compared in Hz and seconds. For directions in which the key is compared as a whole: not
/// `larger_of_each`, `as_it_is_used` and `inner_design`. Needs the upward rounding mode.
[[nodiscard]] Relation relation_of(const ContractValue& before, const ContractValue& after,
                                   const certificates::KeyContract& contract);

/// The same of two formulas, numbers as a rule, of which the larger one is stronger; null where there is
/// none.
[[nodiscard]] Relation relation_of_formulas(const std::string* before, const std::string* after);

}  // namespace veritrack::reports
