// The single-channel tracker with its gain and frequency frozen, a linear filter: its poles.
#pragma once

#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// Objects unless radius and conditions of Jury are those of z^2 - z (K2 sin x3 + (2 - K1) cos x3) + 1 - K1,
/// at the gain and the frequency that the derivation chose. That this is the denominator is the claim
/// proposition-1/response-corrected.
void check_transfer_function(const Tree& derivation, Objections& objections);

}  // namespace veritrack::checker
