// The tables that every derivation has in certificate.md.
#pragma once

#include <string>

#include "analysis/theorems/derivation.hpp"

namespace veritrack::certificates::markdown {

/// The conditions with their verdicts and grounds; those that are not PROVED stand first.
[[nodiscard]] std::string conditions_table(const theorems::Derivation& derivation);

/// The quantities: symbol, formula, value. `describe` is the text of a quantity's name for people.
[[nodiscard]] std::string quantities_table(const theorems::Derivation& derivation,
                                           std::string (*describe)(const std::string& name));

/// The notes as a list; empty when there are none.
[[nodiscard]] std::string notes_list(const theorems::Derivation& derivation);

}  // namespace veritrack::certificates::markdown
