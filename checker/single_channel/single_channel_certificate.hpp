// A certificate of the single-channel tracker, part by part.
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

/// Throws Malformed for what is not a certificate of this tracker.
void verify_single_channel_tracker(const Tree& certificate, Verification& result);

}  // namespace veritrack::checker
