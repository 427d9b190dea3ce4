// The whole certificate: every part that claims something is verified, or says why not.
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

/// Throws Malformed for what is not a certificate of this format.
Verification verify(const Tree& certificate);

}  // namespace veritrack::checker
