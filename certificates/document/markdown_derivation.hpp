// The tables that every derivation has in certificate.md.
#pragma once

#include <string>

#include "analysis/theorems/derivation.hpp"

namespace veritrack::certificates::markdown {

/// The conditions with their verdicts and grounds; those that are not PROVED stand first.
[[nodiscard]] std::string conditions_table(const theorems::Derivation& derivation);

/// How a quantity is shown to people.
struct QuantityText {
  std::string description;                                         ///< what it is, with its unit
  std::string (*value)(const rigor::Interval& value, int digits);  ///< enclosure, at_most or at_least
};

/// The quantities: what they are, symbol, formula, value to four digits. `describe` tells by the name.
[[nodiscard]] std::string quantities_table(const theorems::Derivation& derivation,
                                           QuantityText (*describe)(const std::string& name));

/// The notes as a list; empty when there are none.
[[nodiscard]] std::string notes_list(const theorems::Derivation& derivation);

}  // namespace veritrack::certificates::markdown
