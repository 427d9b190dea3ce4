// What double precision makes of trackers/factored_covariance.hpp, `turned`: sine and cosine are within one
// unit in the last place.
#pragma once

#include <utility>

#include "checker/numbers/rounded_value.hpp"

namespace veritrack::checker {

/// A component of a turned vector, of which `x` bounds the components.
RoundedValue turned_component(const RoundedValue& x);

/// The entries on and beside the diagonal of a turned positive semidefinite 2x2 matrix, of which `diagonal`
/// and `beside` bound those before; their sizes are not the least that are known.
std::pair<RoundedValue, RoundedValue> turned_block(const RoundedValue& diagonal, const RoundedValue& beside);

}  // namespace veritrack::checker
