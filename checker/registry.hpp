// The kinds of trackers that the checker knows (trackers.def).
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

/// Verifies a certificate of the kind that its design names. A kind that is not in the registry is a part
/// without a check, so that nothing is verified.
void verify_tracker(const Tree& certificate, bool all_boxes, Verification& result);

}  // namespace veritrack::checker
