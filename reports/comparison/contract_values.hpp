// Two values of a key of a design: which of them makes the stronger contract?
#pragma once

#include <string>

#include "certificates/design/key_contract.hpp"
#include "reports/comparison/measured_number.hpp"

namespace veritrack::reports {

/// The second of two values compared with the first; `incomparable` when the comparison is not certain.
enum class Relation { equal, stronger, weaker, incomparable };

/// Numbers in Hz are compared with numbers in rad/sample by the sample rates; with two different sample rates
/// everything is compared in Hz and seconds. For directions in which the key is compared as a whole: not
/// `larger_of_each`, `as_it_is_used` and `inner_design`. Needs the upward rounding mode.
[[nodiscard]] Relation relation_of(const ContractValue& before, const ContractValue& after,
                                   const certificates::KeyContract& contract);

/// The same for two formulas, usually numbers, the larger of which is stronger; null where one is missing.
[[nodiscard]] Relation relation_of_formulas(const std::string* before, const std::string* after);

}  // namespace veritrack::reports
