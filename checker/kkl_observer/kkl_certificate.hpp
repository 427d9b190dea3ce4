// A certificate of the KKL observer, part by part.
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

/// Throws Malformed for what is not a certificate of this observer.
void verify_kkl_observer(const Tree& certificate, Verification& result);

}  // namespace veritrack::checker
