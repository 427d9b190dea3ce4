// A certificate of the quadrature tracker, part by part.
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

/// Throws Malformed for what is not a certificate of this tracker.
void verify_quadrature_tracker(const Tree& certificate, bool all_boxes, Verification& result);

}  // namespace veritrack::checker
