// The tables that every derivation has in certificate.md.
#pragma once

#include <string>

#include "analysis/statements/derivation.hpp"

namespace veritrack::certificates::markdown {

/// The conditions with their verdicts and grounds; those that are not PROVED come first.
[[nodiscard]] std::string conditions_table(const theorems::Derivation& derivation);

/// The value of a quantity, according to its sense; `enclosure_digits` for an enclosure, four for a bound.
[[nodiscard]] std::string value_text(const theorems::Quantity& quantity, int enclosure_digits = 4);

/// The quantities: name, symbol, formula, value.
[[nodiscard]] std::string quantities_table(const theorems::Derivation& derivation, int enclosure_digits = 4);

/// The same without symbols and formulas.
[[nodiscard]] std::string values_table(const theorems::Derivation& derivation);

/// The notes as a list; empty when there are none.
[[nodiscard]] std::string notes_list(const theorems::Derivation& derivation);

}  // namespace veritrack::certificates::markdown
