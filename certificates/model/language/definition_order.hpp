// The order in which the definitions of a step can be computed.
#pragma once

#include <vector>

#include "certificates/model/language/expression.hpp"

namespace veritrack::certificates::language {

/// The definitions in an order in which each uses earlier ones only: among those that are possible, the first
/// in the file comes first. They point into `definitions`. Throws LanguageError when a name is defined twice,
/// or when definitions need each other in a circle.
[[nodiscard]] std::vector<const Definition*> in_order(const std::vector<Definition>& definitions);

}  // namespace veritrack::certificates::language
