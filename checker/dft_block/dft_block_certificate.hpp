// The block tracker as a kind of tracker.
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

TrackerKind dft_block_tracker();

}  // namespace veritrack::checker
