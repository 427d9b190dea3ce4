// Certificates for trackers that are given as recursions.
#pragma once

#include "checker/document/parts.hpp"

namespace veritrack::checker {

TrackerKind model_tracker();

}  // namespace veritrack::checker
