// Is |T e+|^2 <= rate^2 |T e|^2 + L_v^2 |v|^2 + L_w^2 w^2 for every step from a set?
#pragma once

#include <cstdint>

#include "checker/quadrature/step.hpp"

namespace veritrack::checker {

/// True only when it is: condition (a) of the theorem of docs/contraction.md. `cells` counts the boxes that
/// were examined.
bool contracts(const Setting& setting, std::int64_t& cells);

/// True only when every step from the set keeps the covariance between its bounds: condition (b).
bool keeps_covariance(const Setting& setting);

}  // namespace veritrack::checker
