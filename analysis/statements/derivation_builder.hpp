// Helpers for building derivations.
#pragma once

#include <string>

#include "analysis/statements/derivation.hpp"

namespace veritrack::theorems {

/// Name, symbol, formula and source of a quantity; see Quantity.
struct QuantityText {
  std::string name, symbol, formula, source;
  std::string words = {};
  Sense sense = Sense::enclosure;
};

/// Sets the value; where it is not finite the quantity is not applicable, for `why_not` (a sentence) or, when
/// that is empty, because it is undefined or overflows.
void set_value(Quantity& quantity, const rigor::Interval& value, std::string why_not = {});

/// Appends a quantity with its value, as set_value does.
void add_quantity(Derivation& derivation, QuantityText text, const rigor::Interval& value,
                  std::string why_not = {});

/// Sets the verdict: the conjunction of all conditions.
void conclude(Derivation& derivation);

}  // namespace veritrack::theorems
