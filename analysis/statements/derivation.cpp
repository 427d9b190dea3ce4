#include "analysis/statements/derivation.hpp"

#include <algorithm>
#include <stdexcept>

namespace veritrack::theorems {

const Quantity& find_quantity(const Derivation& derivation, const std::string& name) {
  const auto found = std::find_if(derivation.quantities.begin(), derivation.quantities.end(),
                                  [&](const Quantity& quantity) { return quantity.name == name; });
  if (found == derivation.quantities.end()) {
    throw std::out_of_range(derivation.id + " has no quantity named " + name);
  }
  return *found;
}

const Quantity* applicable_quantity(const Derivation& derivation, std::string_view name) {
  const auto found = std::find_if(
      derivation.quantities.begin(), derivation.quantities.end(),
      [&](const Quantity& quantity) { return quantity.name == name && !quantity.not_applicable; });
  return found == derivation.quantities.end() ? nullptr : &*found;
}

}  // namespace veritrack::theorems
