// The quantities of Theorem 2.9 for the document: name, symbol, formula, source.
#pragma once

#include <string>
#include <vector>

#include "analysis/statements/derivation.hpp"
#include "analysis/theorems/theorem_2_9_constants.hpp"

namespace veritrack::theorems {

/// The names of certificate.json with their enclosures, in the order in which the thesis introduces them.
/// Quantities that divide by q1 are not applicable when q1 may be zero; any other one that is not finite is
/// marked as such.
[[nodiscard]] std::vector<Quantity> theorem_2_9_quantities(Theorem29Variant variant,
                                                           const Theorem29Input& input,
                                                           const Theorem29Constants& constants);

/// Why the quantity of that name does not exist for the design, as a sentence; nothing when it does.
[[nodiscard]] std::optional<std::string> why_not_applicable(const std::string& name,
                                                            const Theorem29Input& input);

}  // namespace veritrack::theorems
