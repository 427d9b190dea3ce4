// trackers/factored_covariance.hpp, `turned`, in double precision: sine and cosine are within one unit in the
// last place.
#pragma once

#include <utility>

#include "checker/numbers/rounded_value.hpp"

namespace veritrack::checker {

/// A component of a turned vector, whose components are bounded by `x`.
RoundedValue turned_component(const RoundedValue& x);

/// The entries on and beside the diagonal of a turned positive semidefinite 2x2 matrix; `diagonal` and
/// `beside` bound those before the turn. Their sizes are not the least known.
std::pair<RoundedValue, RoundedValue> turned_block(const RoundedValue& diagonal, const RoundedValue& beside);

}  // namespace veritrack::checker
